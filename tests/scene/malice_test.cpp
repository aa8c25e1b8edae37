// Files that are no scenes at all, or want to hurt: each must end with a message.
#include "scene/document.h"
#include "scene_testing.h"

namespace carom {
namespace {

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
}

TEST(Malice, NothingAtAll) {
    for (const char* text : {"", "\n\n", "# only a comment\n", "---\n", "---\n...\n", "~"})
        EXPECT_EQ(errors_of(text), "t.yaml:1:1: error: the document is empty\n") << text;
}

TEST(Malice, BrokenYaml) {
    const auto expect = [](const std::string& text, const std::string& start) {
        const std::string errors = errors_of(text);
        EXPECT_EQ(errors.substr(0, start.size()), start) << text << "\n" << errors;
        EXPECT_EQ(errors.find('\n'), errors.size() - 1) << "one message: " << errors;
    };
    expect("carom: 1\nfilm: {fps: 60\n",
           "t.yaml:3:1: error: not valid YAML: end of map flow not "
           "found; is the bracket opened in line 2 closed?");
    expect("carom: 1\nfilm: {size: [1, 2}\n",
           "t.yaml:2:19: error: not valid YAML: illegal flow end");
    expect("carom: 1\ntitle: \"abc\n", "t.yaml:3:1: error: not valid YAML:");
    expect("carom: 1\ntitle: 'abc", "t.yaml:2:12: error: not valid YAML:");
    expect("carom: 1\n\tfilm: 1\n", "t.yaml:2:1: error: not valid YAML: a tab stands");
    expect("carom: 1\ntitle: a: b\n", "t.yaml:2:9: error: not valid YAML: illegal map value");
    expect("carom: 1\ntitle: @b\n", "t.yaml:2:8: error: not valid YAML: unknown token");
    expect("carom: 1\n---\ncarom: 1\n", "t.yaml:2:1: error: a second document begins here");
    expect("carom: &x 1\n", "t.yaml:1:8: error: anchors (&name) are not supported");
    expect("a: &x [1]\nb: [*x, *x]\n", "t.yaml:1:4: error: anchors (&name) are not supported");
    expect("carom: *x\n", "t.yaml:1:8: error: not valid YAML: the referenced anchor");
    expect("carom: !!int 1\n", "t.yaml:1:8: error: tags (!name) are not supported");
    expect("? [a, b]\n: 1\n", "t.yaml:1:3: error: a key must be a plain word");
    expect(": 1\n", "t.yaml:1:1: error: a key is missing before ':'");
}

TEST(Malice, Encodings) {
    EXPECT_EQ(errors_of("\xEF\xBB\xBF"
                        "carom: 1\r\ntitle: x\r\n"),
              "");
    EXPECT_EQ(errors_of("carom: 1\r\n\r\ntitel: x\r\n"),
              "t.yaml:3:1: error: unknown key 'titel'; did you mean 'title'?\n");
    EXPECT_EQ(errors_of("\xFF\xFE"
                        "c\0"),
              "t.yaml:1:1: error: the file is UTF-16; save it as UTF-8\n");
    EXPECT_EQ(errors_of("carom: 1\ntitle: a\xE9z\n"),
              "t.yaml:2:9: error: this byte is not UTF-8; save the file as UTF-8\n");
    for (const char* bad : {"\xC0\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE2\x82", "\x80"})
        EXPECT_EQ(errors_of(std::string("carom: 1\ntitle: ") + bad),
                  "t.yaml:2:8: error: this byte is not UTF-8; save the file as UTF-8\n");
    EXPECT_EQ(errors_of(std::string("carom: 1\0\n", 10)),
              "t.yaml:1:9: error: control character 0x00 in the text; remove it\n");
    EXPECT_EQ(errors_of("carom: 1\ntitle: \x1b[31m\n"),
              "t.yaml:2:8: error: control character 0x1b in the text; remove it\n");
}

TEST(Malice, Depth) {
    for (const char* part :
         {"[", "{", "- ", "? ", "{a: ", "[a: ", "- - [{", "a:\n", "!", "&a ", "*"}) {
        const std::string errors = errors_of(repeated(part, 100000));
        EXPECT_EQ(errors.substr(0, 7), "t.yaml:") << part;
        EXPECT_NE(errors.find(": error: "), std::string::npos) << part;
    }
    const std::string nested = "carom: 1\nx: " + repeated("[", 40) + repeated("]", 40);
    EXPECT_NE(errors_of(nested).find("nested more than 32 levels deep"), std::string::npos);
    std::string block = "carom: 1\n";
    for (int i = 0; i < 200; ++i) block += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
    EXPECT_NE(errors_of(block).find("nested more than 32 levels deep"), std::string::npos);
}

TEST(Malice, Size) {
    EXPECT_EQ(errors_of(std::string(kMaxDocumentBytes + 1, ' ')),
              "t.yaml: error: the file has 16777217 bytes; a scene may have at most 16777216 (16 "
              "MiB)\n");
    const std::string many = errors_of("carom: 1\nx: [" + repeated("1,", 2100000) + "]");
    EXPECT_NE(many.find("more than 2000000 values"), std::string::npos) << many.substr(0, 200);
}

TEST(Malice, MoreMistakesThanAnyoneReads) {
    std::string text = "carom: 1\n";
    for (int i = 0; i < 3000; ++i) text += "k" + std::to_string(i) + ": 1\n";
    const SceneResult result = read_scene(text, "t.yaml");
    EXPECT_EQ(result.diagnostics.items().size(), 1001U);
    EXPECT_EQ(result.diagnostics.items().front().message,
              "more than 1000 mistakes; the rest is not listed");
}

TEST(Malice, LongWordsAreCut) {
    const std::string errors = errors_of("carom: 1\n" + std::string(1000000, 'x') + ": 1\n");
    EXPECT_LT(errors.size(), 400U);
    EXPECT_EQ(errors_of("carom: 1\ntitle: [" + std::string(300, 'a') + "]").size(),
              std::string("t.yaml:2:8: error: 'title' must be text (in quotes if it looks like a "
                          "number), not a list of 1\n")
                  .size());
}

TEST(Malice, NumbersOfTheCoreSchema) {
    const auto step = [](const std::string& text) {
        return scene_of("carom: 1\nsimulation: {step: " + text + "}").simulation.step;
    };
    EXPECT_EQ(step("1e-3"), 1e-3);
    EXPECT_EQ(step("1E+1"), 10);
    EXPECT_EQ(step("+.5"), 0.5);
    EXPECT_EQ(step("2."), 2);
    EXPECT_EQ(step("0x10"), 16);
    EXPECT_EQ(step("0o17"), 15);
    EXPECT_EQ(step("017"), 17);
    EXPECT_EQ(step("0.1"), 0.1);
    for (const char* text :
         {"1_000", "1,5", "0b11", "1e", "e5", ".", "-", "0x", "1:30", "ten", "1 2"})
        EXPECT_NE(
            errors_of(std::string("carom: 1\nsimulation: {step: \"\", x: 0}\nfilm: {speed: ") +
                      text + "}"),
            "")
            << text;
    for (const char* text : {".inf", "-.INF", "+.Inf", ".nan", ".NaN", "1e999", "-1e999"})
        EXPECT_EQ(
            errors_of(std::string("carom: 1\nfilm: {speed: ") + text + "}"),
            std::string("t.yaml:2:15: error: 'speed' must be a finite number, not ") + text + "\n");
    for (const char* text : {"yes", "on", "\"true\"", "1"})
        EXPECT_NE(errors_of(std::string("carom: 1\noverlay: {ruler: ") + text + "}"), "") << text;
    EXPECT_TRUE(scene_of("carom: 1\noverlay: {ruler: TRUE, clock: False}").overlay.ruler);
}

/// Every prefix of a scene, and every scene with one byte changed, must end with a scene or with
/// messages.
TEST(Malice, TruncatedAndScratchedFiles) {
    const std::string text =
        "carom: 1\nmaterials: {m: {restitution: 0.5, friction: 0.1}}\nsurfaces:\n- {name: f, "
        "plane: "
        "{normal: [0, 0, 1]}, material: m}\nballs:\n- name: a\n  radius: 0.1\n  position: [0, 0, "
        "1]\n  repeat: {count: [2, 1, 1], spacing: 1}\noverlay: {ruler: true}\n";
    int accepted = 0, refused = 0;
    const auto run = [&](const std::string& scratched) {
        const SceneResult result = read_scene(scratched, "t.yaml");
        EXPECT_EQ(result.scene.has_value(), !result.diagnostics.has_errors()) << scratched;
        ++(result.scene ? accepted : refused);
    };
    for (std::size_t i = 0; i <= text.size(); ++i) run(text.substr(0, i));
    for (std::size_t i = 0; i < text.size(); ++i)
        for (const char c : {'[', ']', '{', '}', ':', '-', '"', '\'', '#', '&', '*', '!', '|', '?',
                             '9', 'e', '\n', '\t', ' '}) {
            std::string scratched = text;
            scratched[i] = c;
            run(scratched);
        }
    EXPECT_GT(accepted, 100);
    EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace carom
