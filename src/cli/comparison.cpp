#include "cli/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/measures_text.h"
#include "core/readable.h"
#include "golden/measures_json.h"

namespace carom {

namespace {

using Json = nlohmann::ordered_json;

bool worse(const ImageMeasures& a, const ImageMeasures& b) {
    if (a.same_size != b.same_size) return !a.same_size;
    if (a.largest != b.largest) return a.largest > b.largest;
    return a.differing > b.differing;
}

}  // namespace

void Comparison::fail(const std::string& name, const std::string& why) {
    if (failed_.empty()) first_ = fmt::format("{}: {}", readable(name), why);
    if (failed_.empty() || failed_.back() != name) failed_.push_back(name);
}

void Comparison::add(const std::string& name, const ImageMeasures& m,
                     const std::function<Image()>& difference) {
    pairs_.push_back({name, m});
    if (!within(tolerance_, m)) fail(name, measures_text(m));
    if (worst_ && !worse(m, pairs_[*worst_].measures)) return;
    worst_ = pairs_.size() - 1;
    if (keeps_picture_) picture_ = m.same_size ? difference() : Image();
}

void Comparison::add_other_time(const std::string& name, double a_s, double b_s) {
    ++other_times_;
    fail(name, fmt::format("shown at {:.6g} s in one, at {:.6g} s in the other", a_s, b_s));
}

void Comparison::add_missing(const std::string& name) {
    ++missing_;
    fail(name, "only in one");
}

const Comparison::Pair* Comparison::first_not_identical() const {
    const auto found = std::find_if(pairs_.begin(), pairs_.end(),
                                    [](const Pair& pair) { return !pair.measures.identical(); });
    return found == pairs_.end() ? nullptr : &*found;
}

std::string Comparison::text() const {
    const std::string limits = "limits: " + limits_text(tolerance_);
    const auto line = [](const char* which, const Pair& pair) {
        return fmt::format("{} {}: {}\n", which, readable(pair.name), measures_text(pair.measures));
    };
    if (same()) {
        const Pair* first = first_not_identical();
        if (first == nullptr)
            return fmt::format("same: {} {} compared, all identical\n", compared(), what_);
        std::string text = fmt::format("same: {} {} compared ({})\n", compared(), what_, limits);
        if (compared() > 1) text += line("first not identical", *first);
        return text + line("worst", pairs_[*worst_]);
    }
    std::string counts =
        fmt::format("{} of {} {} differ", failed_.size(), compared() + missing_, what_);
    if (other_times_ > 0) counts += fmt::format(", {} shown at other times", other_times_);
    if (missing_ > 0) counts += fmt::format(", {} only in one", missing_);
    std::string text = fmt::format("different: {} ({})\nfirst {}\n", counts, limits, first_);
    if (worst_) text += line("worst", pairs_[*worst_]);
    return text;
}

Json Comparison::json() const {
    const Pair worst = worst_ ? pairs_[*worst_] : Pair{};
    const Pair* first = first_not_identical();
    Json json = {{"same", same()},
                 {"limits", limits_json(tolerance_)},
                 {"compared", compared()},
                 {"differing", failed_.size()},
                 {"only_in_one", missing_},
                 {"at_other_times", other_times_},
                 {"first", first_},
                 {"first_differing", failed_.empty() ? Json(nullptr) : Json(failed_.front())},
                 {"first_not_identical", first == nullptr ? Json(nullptr) : Json(first->name)},
                 {"worst", worst.name}};
    put_measures(json, worst.measures);
    json["differs"] = failed_;
    json["pairs"] = Json::array();
    for (const Pair& pair : pairs_) {
        Json entry = {{"name", pair.name}, {"same", within(tolerance_, pair.measures)}};
        put_measures(entry, pair.measures);
        json["pairs"].push_back(std::move(entry));
    }
    return json;
}

}  // namespace carom
