#include "scene/document.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <sstream>
#include <unordered_map>

#include "scene/odd_blank.h"
#include "scene/scalar.h"
#include "scene/source_text.h"

namespace carom {

namespace {

/// Ends the parse; thrown and caught in this file only.
struct Stop {
    SourceMark mark;
    std::string message;
};

/// Builds the tree from yaml-cpp's events. Events rather than its nodes, because they show keys
/// that stand twice, say where keys stand, and can be stopped before the depth hurts.
class TreeBuilder final : public YAML::EventHandler {
  public:
    TreeBuilder(const SourceText& source, const std::string& file, Diagnostics& diagnostics)
        : source_(source), file_(file), diagnostics_(diagnostics) {}

    std::optional<Node> take_root() { return std::move(root_); }

    /// Where the innermost list or mapping that is still open begins; unknown if none is.
    SourceMark open_mark() const { return open_.empty() ? SourceMark{} : open_.back().node.mark; }

    void OnDocumentStart(const YAML::Mark& mark) override {
        if (root_) throw Stop{at(mark), "a second document begins here; a scene is one document"};
    }
    void OnDocumentEnd() override {}

    void OnNull(const YAML::Mark& mark, YAML::anchor_t) override {
        Node node;
        node.mark = at(mark);
        place(std::move(node));
    }
    void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
        throw Stop{at(mark), "aliases (*name) are not supported; write the value out"};
    }
    // The mark of an anchor may be that of its node; both begin where the user has to look.
    void OnAnchor(const YAML::Mark& mark, const std::string&) override {
        throw Stop{at(mark), "anchors (&name) are not supported; write the value out"};
    }

    void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                  const std::string& value) override {
        refuse_tag(mark, tag);
        Node node;
        node.kind = Node::Kind::kScalar;
        node.quoted = tag == "!";
        node.mark = at(mark);
        node.text = value;
        place(std::move(node));
    }

    void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                         YAML::EmitterStyle::value) override {
        refuse_tag(mark, tag);
        begin(Node::Kind::kList, mark);
    }
    void OnSequenceEnd() override { end(); }

    void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                    YAML::EmitterStyle::value) override {
        refuse_tag(mark, tag);
        begin(Node::Kind::kMap, mark);
    }
    void OnMapEnd() override {
        drop_repeated_keys(open_.back().node);
        end();
    }

    SourceMark at(const YAML::Mark& mark) const { return source_.mark(mark.line, mark.column); }

  private:
    struct Frame {
        Node node;
        bool expects_key = false;
        std::string key;
        SourceMark key_mark;
    };

    void refuse_tag(const YAML::Mark& mark, const std::string& tag) const {
        if (tag.empty() || tag == "?" || tag == "!") return;
        throw Stop{at(mark), "tags (!name) are not supported; write the value without it"};
    }

    void begin(Node::Kind kind, const YAML::Mark& mark) {
        if (!open_.empty() && open_.back().expects_key)
            throw Stop{at(mark),
                       "a key must be a plain word, not a list or a mapping; "
                       "or is this bracket not closed?"};
        if (static_cast<int>(open_.size()) >= kMaxDocumentDepth)
            throw Stop{at(mark), fmt::format("nested more than {} levels deep", kMaxDocumentDepth)};
        Frame frame;
        frame.node.kind = kind;
        frame.node.mark = at(mark);
        frame.expects_key = kind == Node::Kind::kMap;
        open_.push_back(std::move(frame));
    }

    void end() {
        Node node = std::move(open_.back().node);
        open_.pop_back();
        place(std::move(node));
    }

    /// Puts a whole value where it belongs: as a key, under its key, into its list, or as the root.
    void place(Node node) {
        if (++values_ > kMaxDocumentValues)
            throw Stop{node.mark,
                       fmt::format("the file has more than {} values", kMaxDocumentValues)};
        if (open_.empty()) {
            root_ = std::move(node);
            return;
        }
        Frame& frame = open_.back();
        if (frame.node.kind == Node::Kind::kList) {
            frame.node.children.push_back(std::move(node));
            return;
        }
        if (frame.expects_key) {
            if (node.kind != Node::Kind::kScalar)
                throw Stop{node.mark, "a key is missing before ':'"};
            frame.key = std::move(node.text);
            frame.key_mark = node.mark;
        } else {
            node.key = std::move(frame.key);
            node.key_mark = frame.key_mark;
            // yaml-cpp marks an empty value at the token after it, which may be lines away.
            if (node.kind == Node::Kind::kNull) node.mark = frame.key_mark;
            frame.node.children.push_back(std::move(node));
        }
        frame.expects_key = !frame.expects_key;
    }

    void drop_repeated_keys(Node& map) {
        std::unordered_map<std::string, SourceMark> seen;
        const auto is_repeated = [&](const Node& entry) {
            const auto [first, fresh] = seen.emplace(entry.key, entry.key_mark);
            if (fresh) return false;
            diagnostics_.add(
                {Severity::kError, file_, entry.key_mark,
                 fmt::format("the key {} stands twice in this mapping; it stands in line "
                             "{} already",
                             quoted_excerpt(entry.key), first->second.line)});
            map.valid = false;
            return true;
        };
        map.children.erase(std::remove_if(map.children.begin(), map.children.end(), is_repeated),
                           map.children.end());
    }

    const SourceText& source_;
    const std::string& file_;
    Diagnostics& diagnostics_;
    std::vector<Frame> open_;
    std::optional<Node> root_;
    std::size_t values_ = 0;
};

/// yaml-cpp's wording, with what to do about it where that can be said.
std::string syntax_message(const std::string& from_yaml_cpp, SourceMark open) {
    const std::string text = "not valid YAML: " + from_yaml_cpp;
    if (from_yaml_cpp.find("flow not found") != std::string::npos ||
        from_yaml_cpp.find("flow end") != std::string::npos)
        return fmt::format(
            "{}; is the bracket opened in line {} closed? (Colours must stand in quotes: ' #' "
            "begins a comment.)",
            text, open.line);
    if (from_yaml_cpp.find("tab") != std::string::npos) return text + "; indent with spaces";
    if (from_yaml_cpp.find("illegal map value") != std::string::npos)
        return text + "; is the indentation right, and is a text with ': ' in it in quotes?";
    if (from_yaml_cpp.find("document indicator") != std::string::npos)
        return text + "; is a quote not closed?";
    return text;
}

/// More brackets than this are open at one place, roughly: quotes are looked at, comments are not.
/// yaml-cpp keeps all tokens of an open bracket, 200 bytes each, before it tells of the first.
bool opens_too_many(const std::string& text) {
    constexpr int kMostOpen = 100'000;
    int open = 0;
    char quote = 0;
    for (const char c : text) {
        if (quote != 0) {
            if (c == quote || c == '\n') quote = 0;
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (c == '[' || c == '{') {
            if (++open > kMostOpen) return true;
        } else if ((c == ']' || c == '}') && open > 0) {
            --open;
        }
    }
    return false;
}

void parse(const std::string& text, YAML::EventHandler& handler) {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(handler)) {
    }
}

}  // namespace

const Node* Node::find(std::string_view wanted) const {
    for (const Node& child : children)
        if (child.key == wanted) return &child;
    return nullptr;
}

Node* Node::find(std::string_view wanted) {
    return const_cast<Node*>(static_cast<const Node*>(this)->find(wanted));
}

std::optional<Node> parse_document(std::string_view text, const std::string& file,
                                   Diagnostics& diagnostics) {
    const std::optional<SourceText> source = SourceText::check(text, file, diagnostics);
    if (!source) return std::nullopt;
    TreeBuilder builder(*source, file, diagnostics);
    Diagnostics ignored;
    const auto fail = [&](SourceMark mark, std::string message) {
        diagnostics.add({Severity::kError, file, mark, std::move(message)});
        return std::nullopt;
    };
    if (opens_too_many(source->text()))
        return fail({1, 1}, fmt::format("nested more than {} levels deep", kMaxDocumentDepth));
    try {
        parse(source->text(), builder);
        // yaml-cpp 0.7 passes a quote that is never closed, unless an explicit end follows it.
        TreeBuilder unused(*source, file, ignored);
        if (source->text().find_first_of("'\"") != std::string::npos)
            parse(source->text() + "\n...\n", unused);
    } catch (const Stop& stop) {
        return fail(stop.mark, stop.message);
    } catch (const YAML::Exception& error) {
        const SourceMark mark = builder.at(error.mark);
        // yaml-cpp finds such a mistake behind its place, and speaks of what it led to.
        if (const auto blank = odd_blank_before(source->text(), mark.line))
            return fail(
                {blank->line, blank->column},
                fmt::format("not valid YAML: {} stands here; write {}", blank->name,
                            blank->name == "a tab" ? "spaces to indent a line" : "a plain space"));
        return fail(mark, syntax_message(error.msg, builder.open_mark()));
    }
    std::optional<Node> root = builder.take_root();
    if (!root || root->kind == Node::Kind::kNull) return fail({1, 1}, "the document is empty");
    return root;
}

namespace {

/// Fowler, Noll and Vo's hash of the bytes of `text` and a 0 behind them.
void add_text(std::uint64_t& hash, std::string_view text) {
    constexpr std::uint64_t kPrime = 0x100000001B3;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * kPrime;
    hash *= kPrime;
}

void add_node(std::uint64_t& hash, const Node& node) {
    add_text(hash, node.key);
    add_text(hash, std::string_view("nslm").substr(static_cast<std::size_t>(node.kind), 1));
    add_text(hash, node.text);
    for (const Node& child : node.children) add_node(hash, child);
    add_text(hash, ".");
}

}  // namespace

std::uint64_t fingerprint(const Node& node) {
    std::uint64_t hash = 0xCBF29CE484222325;
    add_node(hash, node);
    return hash;
}

}  // namespace carom
