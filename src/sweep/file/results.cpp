#include "sweep/file/results.h"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "core/failure.h"
#include "scene/scalar.h"
#include "sweep/file/measured.h"

namespace carom {

namespace {

/// muParser hands it on to the functions: which run they are about. Null while an expression is
/// only looked at.
struct Subject {
    const MeasuredRun* run = nullptr;
};

const MeasuredRun* run_of(void* subject) { return static_cast<Subject*>(subject)->run; }

/// From a member of MeasuredRun to what muParser calls.
template <auto Member>
double of_name(void* subject, const char* name) {
    return run_of(subject) == nullptr ? 0 : (run_of(subject)->*Member)(name);
}
template <auto Member>
double of_name_and_number(void* subject, const char* name, double number) {
    return run_of(subject) == nullptr ? 0 : (run_of(subject)->*Member)(name, number);
}
template <int SweepAxis>
double coordinate(void* subject, const char* name, double t) {
    return run_of(subject) == nullptr ? 0 : run_of(subject)->coordinate(name, SweepAxis, t);
}
template <int SweepAxis>
double velocity(void* subject, const char* name, double t) {
    return run_of(subject) == nullptr ? 0 : run_of(subject)->velocity(name, SweepAxis, t);
}
template <EventKind Kind>
double begin_of(void* subject, const char* name) {
    return run_of(subject) == nullptr ? 0 : run_of(subject)->event_time(name, Kind);
}

void define(mu::Parser& parser, Subject& subject, double& duration, double& balls) {
    // Nothing may be computed once for all runs: the functions depend on the subject.
    constexpr bool kFold = false;
    const auto named = [&](const char* name, double (*f)(void*, const char*)) {
        parser.DefineFunUserData(name, f, &subject, kFold);
    };
    const auto numbered = [&](const char* name, double (*f)(void*, const char*, double)) {
        parser.DefineFunUserData(name, f, &subject, kFold);
    };
    using Run = MeasuredRun;
    named("peaks", of_name<&Run::peaks>);
    named("impacts", of_name<&Run::impacts>);
    named("slide_time", begin_of<EventKind::kSlide>);
    named("roll_time", begin_of<EventKind::kRoll>);
    named("rest_time", begin_of<EventKind::kRest>);
    named("leave_time", begin_of<EventKind::kLeave>);
    numbered("peak", of_name_and_number<&Run::peak>);
    numbered("peak_time", of_name_and_number<&Run::peak_time>);
    numbered("impact_time", of_name_and_number<&Run::impact_time>);
    numbered("approach_speed", of_name_and_number<&Run::approach_speed>);
    numbered("separation_speed", of_name_and_number<&Run::separation_speed>);
    numbered("impulse", of_name_and_number<&Run::impulse>);
    numbered("x", coordinate<0>);
    numbered("y", coordinate<1>);
    numbered("z", coordinate<2>);
    numbered("vx", velocity<0>);
    numbered("vy", velocity<1>);
    numbered("vz", velocity<2>);
    numbered("speed", of_name_and_number<&Run::speed>);
    numbered("spin", of_name_and_number<&Run::spin>);
    numbered("kinetic_energy", of_name_and_number<&Run::kinetic_energy>);
    numbered("energy", of_name_and_number<&Run::energy>);
    parser.DefineVar("duration", &duration);
    parser.DefineVar("balls", &balls);
}

/// What the name that a function is given may be.
enum class NameKind { kBall, kBallOrAll, kPair };

/// Of another function muParser says that it is none.
NameKind kind_of(std::string_view function) {
    constexpr std::string_view kOfBalls[] = {"peaks", "peak", "peak_time", "x",     "y",   "z",
                                             "vx",    "vy",   "vz",        "speed", "spin"};
    if (std::ranges::find(kOfBalls, function) != std::end(kOfBalls)) return NameKind::kBall;
    return function == "energy" || function == "kinetic_energy" ? NameKind::kBallOrAll
                                                                : NameKind::kPair;
}

/// A text in quotes, and the function in whose brackets it stands.
struct QuotedName {
    std::string function, text;
};

/// The word before the bracket that is the last character; "" for none.
std::string function_before(std::string_view expression) {
    const auto trim = [&] {
        while (expression.ends_with(' ')) expression.remove_suffix(1);
    };
    trim();
    if (!expression.ends_with('(')) return "";
    expression.remove_suffix(1);
    trim();
    const std::size_t before = expression.find_last_not_of("abcdefghijklmnopqrstuvwxyz_");
    return std::string(expression.substr(before == expression.npos ? 0 : before + 1));
}

std::vector<QuotedName> names_in(std::string_view expression) {
    std::vector<QuotedName> names;
    std::size_t open = expression.find('"');
    while (open != expression.npos) {
        const std::size_t close = expression.find('"', open + 1);
        if (close == expression.npos) break;
        names.push_back({function_before(expression.substr(0, open)),
                         std::string(expression.substr(open + 1, close - open - 1))});
        open = expression.find('"', close + 1);
    }
    return names;
}

/// Why there can be no such name; "" where there is.
std::string wrong_name(const QuotedName& name, const ResultNames& known) {
    const NameKind kind = kind_of(name.function);
    const std::size_t slash = name.text.find('/');
    if (kind != NameKind::kPair && (slash != std::string::npos || name.text == "*") &&
        !(kind == NameKind::kBallOrAll && name.text == "*"))
        return fmt::format("{}() is of one ball, not of {}", name.function,
                           quoted_excerpt(name.text));
    std::vector<std::string> names = known.balls;
    if (kind == NameKind::kPair)
        names.insert(names.end(), known.surfaces.begin(), known.surfaces.end());
    std::vector<std::string> parts = {name.text.substr(0, slash)};
    if (slash != std::string::npos) parts.push_back(name.text.substr(slash + 1));
    for (const std::string& part : parts) {
        if (part == "*" || std::ranges::find(names, part) != names.end()) continue;
        const auto begins = [&](const std::string& prefix) { return part.starts_with(prefix); };
        if (std::ranges::any_of(known.drawn, begins)) continue;
        return fmt::format("there is no {} {}{}",
                           kind == NameKind::kPair ? "ball or surface" : "ball",
                           quoted_excerpt(part), suggestion(part, names));
    }
    return "";
}

/// muParser would set a variable, for all columns that follow.
bool has_assignment(std::string_view expression) {
    bool in_quotes = false;
    for (std::size_t i = 0; i < expression.size(); ++i) {
        const char c = expression[i], next = i + 1 < expression.size() ? expression[i + 1] : ' ';
        if (c == '"') in_quotes = !in_quotes;
        if (in_quotes) continue;
        if (c == '=' && next != '=') return true;
        if (next == '=' && std::string_view("=!<>").find(c) != std::string_view::npos) ++i;
    }
    return false;
}

}  // namespace

const std::vector<ResultFunction>& result_functions() {
    static const std::vector<ResultFunction> kAll = {
        {"peaks(\"a\")", "", "how many peaks ball a has"},
        {"peak(\"a\", 1)", "m", "the gap under it at its first peak"},
        {"peak_time(\"a\", 1)", "s", "when that is"},
        {"impacts(\"a\")", "", "how many impacts it has"},
        {"impact_time(\"a\", 1)", "s", "when the first one is"},
        {"approach_speed(\"a\", 1)", "m/s", "along the normal before it"},
        {"separation_speed(\"a\", 1)", "m/s", "along the normal after it"},
        {"impulse(\"a\", 1)", "N s", "along the normal"},
        {"slide_time(\"a\")", "s", "when the first sliding contact begins"},
        {"roll_time(\"a\")", "s", "when the first rolling one begins"},
        {"rest_time(\"a\")", "s", "when it first comes to rest"},
        {"leave_time(\"a\")", "s", "when a lasting contact first ends"},
        {"x(\"a\", 0.5)", "m", "where its centre is after 0.5 s; also `y`, `z`"},
        {"vx(\"a\", 0.5)", "m/s", "its velocity then; also `vy`, `vz`"},
        {"speed(\"a\", 0.5)", "m/s", "the length of that"},
        {"spin(\"a\", 0.5)", "rad/s", "the length of its angular velocity"},
        {"kinetic_energy(\"a\", 0.5)", "J", "of translation and rotation; `\"*\"`: of all balls"},
        {"energy(\"a\", 0.5)", "J", "the same with that of its place, 0 at the origin"},
        {"duration", "s", "of the motion"},
        {"balls", "", "how many balls the scene has"},
    };
    return kAll;
}

std::string result_reference_markdown() {
    std::string text = "### Functions of results\n\n| Example | Unit | Value |\n|---|---|---|\n";
    for (const ResultFunction& one : result_functions())
        text += fmt::format("| `{}` | {} | {} |\n", one.example, one.unit, one.meaning);
    return text + "\n";
}

std::string wrong_expression(const std::string& expression, const ResultNames& known) {
    for (const QuotedName& name : names_in(expression))
        if (std::string wrong = wrong_name(name, known); !wrong.empty()) return wrong;
    if (has_assignment(expression))
        return "not an expression: '=' sets nothing here; '==' compares";
    Subject subject;
    double duration = 1, balls = 1;
    try {
        mu::Parser parser;
        define(parser, subject, duration, balls);
        parser.SetExpr(expression);
        parser.Eval();
        if (parser.GetNumResults() != 1)
            return fmt::format("not an expression: these are {}", parser.GetNumResults());
    } catch (const mu::Parser::exception_type& error) {
        return fmt::format("not an expression: {}", error.GetMsg());
    }
    return "";
}

class ResultTable::Impl {
  public:
    explicit Impl(const std::vector<ResultSpec>& specs) : specs_(specs), parsers_(specs.size()) {
        for (std::size_t i = 0; i < specs.size(); ++i) {
            define(parsers_[i], subject_, duration_, balls_);
            parsers_[i].SetExpr(specs[i].expression);
        }
    }

    std::vector<std::optional<double>> evaluate(const Scene& scene, const Motion& motion) {
        const MeasuredRun run(scene, motion);
        subject_.run = &run;
        duration_ = run.duration();
        balls_ = run.balls();
        std::vector<std::optional<double>> values;
        for (std::size_t i = 0; i < parsers_.size(); ++i) values.push_back(value(i));
        subject_.run = nullptr;
        return values;
    }

  private:
    std::optional<double> value(std::size_t i) {
        try {
            const double number = parsers_[i].Eval();
            return std::isfinite(number) ? std::optional(number) : std::nullopt;
        } catch (const mu::Parser::exception_type& error) {
            throw Failure(FailureKind::kRun,
                          fmt::format("results: {}: {}", specs_[i].name, error.GetMsg()));
        }
    }

    std::vector<ResultSpec> specs_;
    std::vector<mu::Parser> parsers_;
    Subject subject_;
    double duration_ = 0, balls_ = 0;
};

ResultTable::ResultTable(const std::vector<ResultSpec>& specs)
    : impl_(std::make_unique<Impl>(specs)) {}
ResultTable::~ResultTable() = default;

std::vector<std::optional<double>> ResultTable::evaluate(const Scene& scene, const Motion& motion) {
    return impl_->evaluate(scene, motion);
}

std::string expression_library_version() { return mu::Parser().GetVersion(mu::pviBRIEF); }

}  // namespace carom
