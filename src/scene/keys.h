// The table of keys: what a scene file may say. The reader, the JSON Schema and the reference in
// docs/scene.md are all made from these rows, so that they cannot disagree.
#pragma once

#include <array>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// The kinds of mappings in a scene file.
enum class Section {
    kScene,
    kSimulation,
    kAir,
    kMaterial,
    kVirtualBody,
    kRestitution,
    kPowerRestitution,
    kViscoelasticRestitution,
    kPair,
    kLook,
    kSurface,
    kPlane,
    kBox,
    kSphere,
    kCapsule,
    kCylinder,
    kRing,
    kBowl,
    kPipe,
    kDefaults,
    kBallDefaults,  ///< the rows of kBall that have `in_defaults`
    kBall,
    kDragTable,
    kLiftTable,
    kRepeat,
    kCamera,
    kCameraKey,
    kFilm,
    kSpeedKey,
    kOverlay,
    kTest,
    kRuler,
    kClock,
    kTrail,
    kLabels,
    kTitle,
    kPeaks,
    kVelocity,
    kPlot,
    kAgainst,
    kSweep,  ///< from here on those of a sweep's file
    kSweepOutputs,
    kSweepDraw,
    kSweepRandom,
    kSweepBalls,
    kSweepBox,
    kSweepCamera,
};
inline constexpr int kSectionCount = static_cast<int>(Section::kSweepCamera) + 1;

/// The kinds of files, each with a table of its own.
enum class FileKind { kScene, kSweep };
constexpr Section top_section(FileKind kind) {
    return kind == FileKind::kSweep ? Section::kSweep : Section::kScene;
}

/// What a value may look like; a key may have several.
using Forms = unsigned;
namespace form {
inline constexpr Forms kNumber = 1U << 0U;
inline constexpr Forms kInteger = 1U << 1U;
inline constexpr Forms kBool = 1U << 2U;
inline constexpr Forms kText = 1U << 3U;
inline constexpr Forms kName = 1U << 4U;         ///< a new name
inline constexpr Forms kReference = 1U << 5U;    ///< a name of `refers_to`
inline constexpr Forms kWord = 1U << 6U;         ///< one of `words`
inline constexpr Forms kColor = 1U << 7U;        ///< "#rrggbb" or "#rgb"
inline constexpr Forms kFraction = 1U << 8U;     ///< "30000/1001"
inline constexpr Forms kNumbers = 1U << 9U;      ///< a list of `count` numbers (0: any count)
inline constexpr Forms kIntegers = 1U << 10U;    ///< a list of `count` whole numbers
inline constexpr Forms kReferences = 1U << 11U;  ///< a list of `count` names of `refers_to`
inline constexpr Forms kMap = 1U << 12U;         ///< a mapping of section `child`
inline constexpr Forms kNamedMaps = 1U << 13U;   ///< a mapping from new names to sections `child`
inline constexpr Forms kMaps = 1U << 14U;        ///< a list of sections `child`
inline constexpr Forms kTexts = 1U << 15U;       ///< a list of texts
inline constexpr Forms kValues = 1U << 16U;      ///< a list of any values, at least one
inline constexpr Forms kNamedTexts = 1U << 17U;  ///< a mapping from new names to texts
/// A mapping from paths into a scene to values; one that is a mapping is of section `child`.
inline constexpr Forms kPaths = 1U << 18U;
}  // namespace form

enum class NameKind { kNone, kMaterial, kLook, kPreset };

/// Bounds of a number, and of each number of a list. Always finite.
struct Range {
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool above_min = false;  ///< min itself is not allowed
    bool below_max = false;  ///< nor max
    double multiple_of = 0;  ///< 0: any
};
constexpr Range at_least(double min) { return {.min = min}; }
constexpr Range above(double min) { return {.min = min, .above_min = true}; }
constexpr Range above_up_to(double min, double max) {
    return {.min = min, .max = max, .above_min = true};
}
constexpr Range between(double min, double max) { return {.min = min, .max = max}; }
/// Keeps every later sum and square finite, and cells of the search for overlaps countable.
inline constexpr Range kCoordinate = between(-1e9, 1e9);
inline constexpr Range kLength = above_up_to(0, 1e9);

/// What the reader takes where a key is left out.
struct Fallback {
    enum class Kind { kNone, kNumber, kBool, kWord, kNumbers };
    Kind kind = Kind::kNone;
    double number = 0;
    bool boolean = false;
    std::string_view word;
    std::array<double, 4> numbers{};
    int count = 0;

    constexpr Fallback() = default;
    constexpr Fallback(double value) : kind(Kind::kNumber), number(value) {}
    constexpr Fallback(int value) : Fallback(static_cast<double>(value)) {}
    constexpr Fallback(bool value) : kind(Kind::kBool), boolean(value) {}
    constexpr Fallback(const char* value) : kind(Kind::kWord), word(value) {}
    constexpr Fallback(std::initializer_list<double> values) : kind(Kind::kNumbers) {
        for (const double value : values) numbers[static_cast<std::size_t>(count++)] = value;
    }
    /// As it would stand in a scene file; "" for none.
    std::string text() const;
};

/// One key of one section.
struct KeySpec {
    Section section = Section::kScene;
    std::string_view key{};
    Forms forms = 0;
    int count = 0;                    ///< entries of a list; 0: any
    Section child = Section::kScene;  ///< of kMap, kNamedMaps, kMaps
    NameKind refers_to = NameKind::kNone;
    std::vector<std::string_view> words{};  ///< of kWord
    Range range{};
    std::string_view unit{};
    Fallback fallback{};
    std::string_view fallback_doc{};  ///< where the default is not a plain value
    bool required = false;
    bool in_defaults = false;
    std::string_view doc{};      ///< one sentence or two
    std::string_view example{};  ///< as it would stand in a scene file
};

/// A rule about keys of one section that stand beside one another.
struct Rule {
    enum class Kind {
        kExactlyOne,
        kAtMostOne,
        kAtLeastOne,
        kAboveZeroWith,  ///< keys[1] must be above 0 where keys[0] is above 0
    };
    Section section;
    Kind kind;
    std::vector<std::string_view> keys;
};

/// What the documents say about a section.
struct SectionDoc {
    Section section;
    std::string_view name;  ///< in the JSON Schema
    std::string_view path;  ///< "simulation", "balls[]", "materials.NAME"
    std::string_view doc;
};

/// The rows, made once for a run and handed around by reference.
class KeyTable {
  public:
    explicit KeyTable(FileKind kind = FileKind::kScene);
    KeyTable(const KeyTable&) = delete;  // what it hands out points into it
    KeyTable& operator=(const KeyTable&) = delete;
    KeyTable(KeyTable&&) = default;
    KeyTable& operator=(KeyTable&&) = default;

    /// In the order of the documents; pointers live as long as the table.
    const std::vector<const KeySpec*>& keys(Section section) const;
    const KeySpec* find(Section section, std::string_view key) const;
    std::vector<std::string> key_names(Section section) const;
    const std::vector<Rule>& rules() const { return rules_; }
    const std::vector<SectionDoc>& sections() const { return sections_; }
    const SectionDoc& section_doc(Section section) const;
    FileKind kind() const { return kind_; }

  private:
    FileKind kind_;
    std::vector<KeySpec> rows_;
    std::vector<Rule> rules_;
    std::vector<SectionDoc> sections_;
    std::array<std::vector<const KeySpec*>, kSectionCount> by_section_;
};

/// The rows themselves, by subject, in the files keys_*.cpp.
std::vector<KeySpec> setup_keys();
std::vector<KeySpec> overlay_keys();
std::vector<KeySpec> material_keys();
std::vector<KeySpec> surface_keys();
std::vector<KeySpec> shape_keys();
std::vector<KeySpec> ball_keys();
std::vector<KeySpec> air_keys();
std::vector<KeySpec> against_keys();
std::vector<Rule> key_rules();
std::vector<SectionDoc> section_docs();

/// Those of a sweep's file (keys_sweep.cpp).
std::vector<KeySpec> sweep_keys();
std::vector<Rule> sweep_rules();
std::vector<SectionDoc> sweep_section_docs();

}  // namespace carom
