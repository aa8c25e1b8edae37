#include "scene/schema.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/check.h"
#include "scene/catalogue.h"
#include "scene/document.h"
#include "scene/keys.h"
#include "scene/scalar.h"

namespace carom {

namespace {

using Json = nlohmann::ordered_json;

/// Whole numbers without ".0", as people write them.
Json number_json(double value) {
    constexpr double kExact = 9007199254740992.0;  // 2^53
    if (value == std::floor(value) && std::abs(value) < kExact)
        return static_cast<long long>(value);
    return value;
}

Json node_json(const Node& node) {
    Json json;
    if (node.kind == Node::Kind::kList) {
        json = Json::array();
        for (const Node& child : node.children) json.push_back(node_json(child));
    } else if (node.kind == Node::Kind::kMap) {
        json = Json::object();
        for (const Node& child : node.children) json[child.key] = node_json(child);
    } else if (node.kind == Node::Kind::kScalar) {
        const Scalar scalar = resolve_scalar(node.text, node.quoted);
        if (scalar.kind == Scalar::Kind::kNumber) return number_json(scalar.number);
        if (scalar.kind == Scalar::Kind::kBool) return scalar.boolean;
        json = node.text;
    }
    return json;
}

/// A value of the table, written as YAML.
Json yaml_json(std::string_view yaml) {
    Diagnostics mistakes;
    const std::optional<Node> node = parse_document(yaml, "table of keys", mistakes);
    CAROM_CHECK(mistakes.items().size(), ==, 0U);
    return node_json(*node);
}

Json number_schema(const KeySpec& spec, const char* type) {
    Json schema = {{"type", type}};
    const Range& range = spec.range;
    if (std::isfinite(range.min))
        schema[range.above_min ? "exclusiveMinimum" : "minimum"] = number_json(range.min);
    if (std::isfinite(range.max))
        schema[range.below_max ? "exclusiveMaximum" : "maximum"] = number_json(range.max);
    if (range.multiple_of != 0) schema["multipleOf"] = number_json(range.multiple_of);
    return schema;
}

Json name_schema() {
    return {{"type", "string"}, {"pattern", kNamePattern}, {"maxLength", kMaxNameLength}};
}

Json reference_schema(const KeySpec& spec) {
    if (spec.refers_to == NameKind::kPreset) return {{"enum", preset_names()}};
    return name_schema();
}

Json list_schema(const KeySpec& spec, const Json& entry) {
    Json schema = {{"type", "array"}, {"items", entry}};
    if (spec.count != 0) schema["minItems"] = schema["maxItems"] = spec.count;
    return schema;
}

class SchemaWriter {
  public:
    explicit SchemaWriter(FileKind kind) : table_(kind) {}

    Json write() const {
        const bool sweep = table_.kind() == FileKind::kSweep;
        const Section top = top_section(table_.kind());
        Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                       {"title", sweep ? "carom sweep" : "carom scene"}};
        schema.update(section(top));
        Json& definitions = schema["$defs"] = Json::object();
        for (const SectionDoc& doc : table_.sections())
            if (doc.section != top) definitions[std::string(doc.name)] = section(doc.section);
        return schema;
    }

  private:
    Json section(Section section) const {
        const SectionDoc& doc = table_.section_doc(section);
        Json schema = {{"type", "object"}, {"description", doc.doc}};
        Json& properties = schema["properties"] = Json::object();
        Json required = Json::array();
        for (const KeySpec* spec : table_.keys(section)) {
            properties[std::string(spec->key)] = property(*spec, section);
            if (spec->required) required.push_back(spec->key);
        }
        if (!required.empty()) schema["required"] = required;
        schema["additionalProperties"] = false;
        Json rules = Json::array();
        for (const Rule& one : table_.rules())
            if (one.section == section) rules.push_back(rule(one));
        if (!rules.empty()) schema["allOf"] = rules;
        return schema;
    }

    Json reference(Section section) const {
        return {{"$ref", fmt::format("#/$defs/{}", table_.section_doc(section).name)}};
    }

    /// One schema for each form that the value may have.
    Json forms(const KeySpec& spec) const {
        const auto takes = [&](Forms forms) { return (spec.forms & forms) != 0; };
        Json all = Json::array();
        if (takes(form::kNumber)) all.push_back(number_schema(spec, "number"));
        if (takes(form::kInteger)) all.push_back(number_schema(spec, "integer"));
        if (takes(form::kBool)) all.push_back({{"type", "boolean"}});
        if (takes(form::kText)) all.push_back({{"type", "string"}});
        if (takes(form::kName)) all.push_back(name_schema());
        if (takes(form::kReference)) all.push_back(reference_schema(spec));
        if (takes(form::kWord)) all.push_back({{"enum", spec.words}});
        if (takes(form::kColor))
            all.push_back({{"type", "string"}, {"pattern", "^#([0-9a-fA-F]{3}|[0-9a-fA-F]{6})$"}});
        if (takes(form::kFraction))
            all.push_back({{"type", "string"}, {"pattern", "^[1-9][0-9]{0,8}/[1-9][0-9]{0,8}$"}});
        if (takes(form::kNumbers)) all.push_back(list_schema(spec, number_schema(spec, "number")));
        if (takes(form::kIntegers))
            all.push_back(list_schema(spec, number_schema(spec, "integer")));
        if (takes(form::kReferences)) all.push_back(list_schema(spec, reference_schema(spec)));
        if (takes(form::kTexts)) all.push_back(list_schema(spec, {{"type", "string"}}));
        if (takes(form::kMap)) all.push_back(reference(spec.child));
        if (takes(form::kNamedMaps))
            all.push_back({{"type", "object"},
                           {"propertyNames", name_schema()},
                           {"additionalProperties", reference(spec.child)}});
        if (takes(form::kMaps))
            all.push_back({{"type", "array"}, {"items", reference(spec.child)}});
        if (takes(form::kValues)) all.push_back({{"type", "array"}, {"minItems", 1}});
        if (takes(form::kNamedTexts))
            all.push_back({{"type", "object"},
                           {"propertyNames", name_schema()},
                           {"additionalProperties", {{"type", "string"}}}});
        if (takes(form::kPaths)) all.push_back(paths_schema(spec));
        return all;
    }

    /// What stands under a path is for the scene to judge, unless it is a mapping.
    Json paths_schema(const KeySpec& spec) const {
        Json value = {
            {"anyOf",
             {{{"type", {"number", "string", "boolean", "array"}}}, reference(spec.child)}}};
        return {
            {"type", "object"}, {"minProperties", 1}, {"additionalProperties", std::move(value)}};
    }

    Json property(const KeySpec& spec, Section section) const {
        std::string description(spec.doc);
        if (!spec.unit.empty()) description += fmt::format(" Unit: {}.", spec.unit);
        const bool has_default = spec.fallback.kind != Fallback::Kind::kNone;
        if (!has_default && !spec.fallback_doc.empty())
            description += fmt::format(" Default: {}.", spec.fallback_doc);
        Json schema = {{"description", description}};
        const Json alternatives = forms(spec);
        if (alternatives.size() == 1)
            schema.update(alternatives.front());
        else
            schema["anyOf"] = alternatives;
        // In defaults.ball a key that is left out changes nothing.
        if (has_default && section != Section::kBallDefaults)
            schema["default"] = yaml_json(spec.fallback.text());
        schema["examples"] = Json::array({yaml_json(spec.example)});
        return schema;
    }

    static Json present(std::string_view key) { return {{"required", {key}}}; }

    static Json rule(const Rule& rule) {
        Json each = Json::array();
        for (const std::string_view key : rule.keys) each.push_back(present(key));
        switch (rule.kind) {
            case Rule::Kind::kExactlyOne:
                return {{"oneOf", each}};
            case Rule::Kind::kAtLeastOne:
                return {{"anyOf", each}};
            case Rule::Kind::kAtMostOne:
                CAROM_CHECK(rule.keys.size(), ==, 2U);
                return {{"not", {{"required", rule.keys}}}};
            case Rule::Kind::kAboveZeroWith:
                break;
        }
        const std::string first(rule.keys[0]), second(rule.keys[1]);
        return {{"anyOf",
                 {{{"properties", {{first, {{"maximum", 0}}}}}},
                  {{"properties", {{second, {{"exclusiveMinimum", 0}}}}}}}}};
    }

    KeyTable table_;
};

}  // namespace

std::string json_schema(FileKind kind) { return SchemaWriter(kind).write().dump(2) + "\n"; }

}  // namespace carom
