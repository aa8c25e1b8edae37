// The documents made from the table of keys, against the table's reader and against docs/scene.md.
#include "scene/schema.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "scene/keys.h"
#include "scene/validate.h"
#include "scene_testing.h"

namespace carom {
namespace {

using Json = nlohmann::json;

std::string file_text(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    EXPECT_TRUE(stream.is_open()) << path;
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// The mapping {key: value} of one row, validated as part of its section; "" if it is right. Other
/// keys that the section asks for are missing, and rules between keys broken: those do not count.
std::string value_errors(const KeyTable& table, const KeySpec& spec, const std::string& value) {
    Report report("t.yaml");
    std::optional<Node> map =
        parse_document(std::string(spec.key) + ": " + value, "t.yaml", report.diagnostics());
    EXPECT_TRUE(map) << value;
    if (!map) return "no YAML";
    validate_section(*map, spec.section, table, report);
    return map->children.at(0).valid ? "" : all_text(report.diagnostics());
}

TEST(KeyTable, ItsExamplesAndDefaultsAreRight) {
    int rows = 0, defaults = 0;
    for (const FileKind kind : {FileKind::kScene, FileKind::kSweep}) {
        const KeyTable table(kind);
        for (int section = 0; section < kSectionCount; ++section)
            for (const KeySpec* spec : table.keys(static_cast<Section>(section))) {
                ++rows;
                EXPECT_FALSE(spec->doc.empty()) << spec->key;
                ASSERT_FALSE(spec->example.empty()) << spec->key;
                EXPECT_EQ(value_errors(table, *spec, std::string(spec->example)), "") << spec->key;
                if (spec->fallback.kind == Fallback::Kind::kNone) continue;
                ++defaults;
                EXPECT_EQ(value_errors(table, *spec, spec->fallback.text()), "") << spec->key;
            }
    }
    EXPECT_GT(rows, 120);
    EXPECT_GT(defaults, 35);
}

TEST(KeyTable, EveryRowIsReadInASceneOfAllKeys) {
    // Wrong values in every place that takes a number: the reader must look at every one of them.
    for (const FileKind kind : {FileKind::kScene, FileKind::kSweep}) {
        const KeyTable table(kind);
        for (int section = 0; section < kSectionCount; ++section)
            for (const KeySpec* spec : table.keys(static_cast<Section>(section))) {
                // Paths are for the scene to judge, and one may lead to a list.
                const bool paths = (spec->forms & form::kPaths) != 0;
                const char* wrong = paths ? "{path: {no_such_key: 1}}" : "{no_such_key: [{}]}";
                EXPECT_NE(value_errors(table, *spec, wrong), "") << spec->key;
            }
    }
}

TEST(Schema, HasEveryKeyWithADescription) {
    const Json schema = Json::parse(json_schema(FileKind::kScene));
    EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    const KeyTable table;
    int keys = 0;
    for (const SectionDoc& doc : table.sections()) {
        const Json& section =
            doc.section == Section::kScene ? schema : schema["$defs"][std::string(doc.name)];
        EXPECT_EQ(section["additionalProperties"], false) << doc.path;
        EXPECT_EQ(section["properties"].size(), table.keys(doc.section).size()) << doc.path;
        for (const KeySpec* spec : table.keys(doc.section)) {
            const Json& property = section["properties"][std::string(spec->key)];
            EXPECT_FALSE(property["description"].get<std::string>().empty()) << spec->key;
            ++keys;
        }
    }
    EXPECT_GT(keys, 80);
    EXPECT_EQ(schema["required"], Json::array({"carom"}));
    const Json& ball = schema["$defs"]["ball"]["properties"];
    EXPECT_EQ(ball["mass"]["default"], 1);
    EXPECT_EQ(schema["$defs"]["simulation"]["properties"]["gravity"]["default"],
              Json::array({0, 0, -9.81}));
}

TEST(Reference, StandsInTheDocs) {
    const std::string docs = file_text(std::string(CAROM_SOURCE_DIR) + "/docs/scene.md");
    const std::string begin = "<!-- reference:begin -->\n", end = "<!-- reference:end -->";
    const std::size_t first = docs.find(begin), last = docs.find(end);
    ASSERT_NE(first, std::string::npos);
    ASSERT_NE(last, std::string::npos);
    const std::size_t start = first + begin.size();
    EXPECT_EQ(docs.substr(start, last - start), reference_markdown(FileKind::kScene))
        << "replace the text between the markers by this one";
}

/// The documentation's example is the one that a reader will copy.
TEST(Docs, ExampleIsARightScene) {
    const std::string docs = file_text(std::string(CAROM_SOURCE_DIR) + "/docs/scene.md");
    const std::string begin = "```yaml\n";
    const std::size_t first = docs.find(begin);
    ASSERT_NE(first, std::string::npos);
    const std::size_t start = first + begin.size();
    const std::string example = docs.substr(start, docs.find("```", start) - start);
    EXPECT_EQ(errors_of(example), "");
    EXPECT_FALSE(scene_of(example).balls.empty());
}

}  // namespace
}  // namespace carom
