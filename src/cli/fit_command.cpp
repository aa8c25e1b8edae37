// carom fit: from measured drops to a coefficient of restitution and a material.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/distinct_files.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/standard_output.h"
#include "cli/usage.h"
#include "core/failure.h"
#include "core/readable.h"
#include "media/output_file.h"
#include "media/wav.h"
#include "report/bounce_onsets.h"
#include "report/fit.h"
#include "report/fit_drag.h"
#include "report/fit_over_speed.h"
#include "report/paper_data.h"
#include "scene/catalogue.h"
#include "scene/report.h"
#include "scene/scalar.h"

namespace carom {

namespace {

/// Numbers with units arrive as text.
struct FitCommandOptions {
    std::vector<std::string> drops, rebounds, intervals;
    std::string csv, wav;
    std::string rebound_to = "bottom";
    std::string diameter;
    std::string reading_error;
    bool air = false;
    double density = Air{}.density;
    std::string ball, radius;
    double mass = 0, drag = 0;
    double constant = kPaperConstant;
    double velocity = kFixedVelocity_m_s;
    std::string name = "measured";
    std::string plot;
    bool overwrite = false;
    bool json = false;
    bool over_speed = false, fit_drag = false;
};

/// One rebound for each drop, or several from one height.
std::vector<MeasuredDrop> paired_drops(const FitCommandOptions& options) {
    const std::size_t drops = options.drops.size(), rebounds = options.rebounds.size();
    if (drops == 0) usage("--rebound needs the height of the --drop");
    if (rebounds == 0) usage("--drop needs the height of the --rebound");
    if (drops != 1 && drops != rebounds)
        usage(
            fmt::format("{} times --drop and {} times --rebound: give one rebound for each drop, "
                        "or one drop for all",
                        drops, rebounds));
    std::vector<MeasuredDrop> result;
    for (std::size_t i = 0; i < rebounds; ++i) {
        const std::string& drop = options.drops[drops == 1 ? 0 : i];
        const std::string where = fmt::format("--drop {} --rebound {}", drop, options.rebounds[i]);
        result.push_back({parse_quantity(drop, Quantity::kLength, "--drop"),
                          parse_quantity(options.rebounds[i], Quantity::kLength, "--rebound"),
                          where});
    }
    return result;
}

/// The distances of the bounces in a recording.
Measurements heard_bounces(const std::string& path) {
    std::vector<double> at;
    try {
        at = bounce_onsets(read_wav(path));
    } catch (const Failure& failure) {
        const std::string text = failure.what();
        if (text.starts_with(readable(path))) throw;
        usage(fmt::format("{}: {}", readable(path), text));
    }
    Measurements result;
    for (std::size_t i = 1; i < at.size(); ++i) result.intervals_s.push_back(at[i] - at[i - 1]);
    return result;
}

Measurements measurements(const FitCommandOptions& options) {
    const bool heights = !options.drops.empty() || !options.rebounds.empty();
    const int sources = (heights ? 1 : 0) + (options.csv.empty() ? 0 : 1) +
                        (options.wav.empty() ? 0 : 1) + (options.intervals.empty() ? 0 : 1);
    if (sources != 1)
        usage(sources == 0
                  ? "nothing measured: give --drop and --rebound, --csv, --intervals or --wav"
                  : "give only one of --drop with --rebound, --csv, --intervals and --wav");
    if (!options.csv.empty()) return read_measurements(options.csv);
    if (!options.wav.empty()) return heard_bounces(options.wav);
    Measurements result;
    if (heights) result.drops = paired_drops(options);
    for (const std::string& text : options.intervals)
        result.intervals_s.push_back(parse_quantity(text, Quantity::kTime, "--intervals"));
    return result;
}

double above_zero(const std::string& text, Quantity quantity, const std::string& option) {
    const double value = parse_quantity(text, quantity, option);
    if (!(value > 0)) usage(fmt::format("{} {}: it must be above 0", option, text));
    return value;
}

struct FlyingBall {
    double radius = 0, mass = 0, drag = 0;  ///< 0: not given
};

/// A preset's numbers, or the options' own where they are given.
FlyingBall flying_ball(const FitCommandOptions& options) {
    const Preset* preset = nullptr;
    if (!options.ball.empty()) {
        preset = find_preset(options.ball);
        if (preset == nullptr)
            usage(fmt::format("--ball {}: there is no preset of that name{}", options.ball,
                              suggestion(options.ball, preset_names())));
    }
    const double radius = options.radius.empty()
                              ? (preset == nullptr ? 0 : preset->radius)
                              : above_zero(options.radius, Quantity::kLength, "--radius");
    const double mass = options.mass > 0 ? options.mass : preset == nullptr ? 0 : preset->mass;
    const double drag = options.drag > 0 ? options.drag : preset == nullptr ? 0 : preset->drag;
    return {radius, mass, drag};
}

Air air_of(const FitCommandOptions& options) {
    Air air;
    air.density = options.density;
    return air;
}

FallInAir fall_in_air(const FitCommandOptions& options) {
    const FlyingBall ball = flying_ball(options);
    if (!(ball.radius > 0 && ball.mass > 0 && ball.drag > 0))
        usage("--air needs the ball: --ball PRESET, or --radius, --mass and --drag");
    return {air_of(options), ball.radius, ball.mass, ball.drag, -Simulation{}.gravity.z()};
}

std::string drag_fit(const FitCommandOptions& options, const Measurements& measured) {
    if (!options.air) usage("--fit-drag is about a ball in air: give --air");
    if (options.drag > 0) usage("--fit-drag finds the drag: leave out --drag");
    if (!measured.drops.empty())
        usage(
            "--fit-drag needs the times between many bounces: --intervals, --wav, or a --csv of "
            "them; a drop's two heights do not tell drag and restitution apart");
    if (options.rebound_to == "top" || !options.diameter.empty())
        usage(
            "--rebound-to top and --diameter are about heights, not about --fit-drag's intervals");
    if (!options.plot.empty()) usage("-o: --fit-drag has no plot");
    const FlyingBall ball = flying_ball(options);
    if (!(ball.radius > 0 && ball.mass > 0))
        usage("--fit-drag needs the ball: --ball PRESET, or --radius and --mass");
    std::optional<double> error;
    if (!options.reading_error.empty())
        error = above_zero(options.reading_error, Quantity::kTime, "--reading-error");
    const DragFit fit =
        fit_drag(measured.intervals_s,
                 {air_of(options), ball.radius, ball.mass, -Simulation{}.gravity.z()}, error);
    return options.json ? drag_fit_json(fit, options.name) : drag_fit_text(fit, options.name);
}

FitOptions fit_options(const FitCommandOptions& options, const Measurements& measured) {
    FitOptions result;
    const bool times = measured.drops.empty();
    const bool to_top = options.rebound_to == "top";
    if (to_top && times) usage("--rebound-to top is about heights, not about intervals");
    if (to_top && options.diameter.empty()) usage("--rebound-to top needs the ball's --diameter");
    if (!to_top && !options.diameter.empty())
        usage("--diameter is only needed with --rebound-to top");
    if (to_top) {
        result.rebound_to = ReboundTo::kTop;
        result.diameter_m = above_zero(options.diameter, Quantity::kLength, "--diameter");
    }
    const bool ball = !options.ball.empty() || !options.radius.empty() || options.mass > 0 ||
                      options.drag > 0 || options.density != Air{}.density;
    if (ball && !options.air)
        usage("--ball, --radius, --mass, --drag and --density are only needed with --air");
    if (options.air) result.air = fall_in_air(options);
    if (!options.reading_error.empty())
        result.reading_error = above_zero(
            options.reading_error, times ? Quantity::kTime : Quantity::kLength, "--reading-error");
    return result;
}

int fit(const FitCommandOptions& options, const Interrupt& interrupt) {
    if (!options.plot.empty()) {
        if (!plot_format_of(options.plot))
            usage(fmt::format("-o {}: a plot is a .svg, .png or .pdf file", options.plot));
        require_distinct({{"-o", options.plot}}, {{"--csv", options.csv}, {"--wav", options.wav}});
        require_writable(options.plot, options.overwrite);
        require_gnuplot(interrupt.token());
    }
    if (!is_name(options.name))
        usage(
            fmt::format("--name {}: a name is a letter or '_' and then letters, digits, '_' or "
                        "'-', at most {} characters",
                        options.name, kMaxNameLength));
    const Measurements measured = measurements(options);
    if (options.fit_drag) {
        write_standard_output(drag_fit(options, measured));
        return kExitDone;
    }
    if (options.over_speed) {
        if (measured.drops.empty())
            usage("--over-speed needs drops from several heights: --drop and --rebound, or --csv");
        const SpeedFit found = fit_over_speed(measured.drops, fit_options(options, measured));
        if (!options.plot.empty())
            write_plot(speed_fit_plot(found), options.plot, existing_of(options.overwrite),
                       interrupt.token());
        write_standard_output(options.json ? speed_fit_json(found, options.name)
                                           : speed_fit_text(found, options.name));
        return kExitDone;
    }
    const RestitutionFit found = fit_restitution(measured, fit_options(options, measured));
    const VirtualBodyLine line =
        virtual_body_line(found.restitution, options.constant, options.velocity);
    if (!options.plot.empty())
        write_plot(fit_plot(found, line), options.plot, existing_of(options.overwrite),
                   interrupt.token());
    write_standard_output(options.json ? fit_json(found, line, options.name)
                                       : fit_text(found, line, options.name));
    return kExitDone;
}

void add_sources(CLI::App& command, FitCommandOptions& options) {
    const auto list = [&](const char* name, std::vector<std::string>& values, const char* what,
                          const char* type) {
        return command.add_option(name, values, what)
            ->type_name(type)
            ->take_all()
            ->allow_extra_args(false);
    };
    list("--drop", options.drops,
         "Height of the ball's bottom in metres, or e.g. 180cm (repeatable)", "H");
    list("--rebound", options.rebounds,
         "Height that it came back to, in metres or with a unit (repeatable)", "h");
    command.add_option("--csv", options.csv, "Columns drop and rebound, or interval, with units")
        ->type_name("FILE");
    list("--intervals", options.intervals,
         "Times between successive bounces in order, in seconds, or e.g. 860ms,730ms", "T,...")
        ->delimiter(',');
    command
        .add_option("--wav", options.wav,
                    "Recording of a ball that bounces: the times between its bounces (default: "
                    "none)")
        ->type_name("FILE");
    command
        .add_option("--rebound-to", options.rebound_to, "What of the ball a rebound is measured to")
        ->check(CLI::IsMember({"bottom", "top"}))
        ->type_name("bottom|top")
        ->capture_default_str();
    command
        .add_option("--diameter", options.diameter,
                    "Diameter of the ball in metres, or e.g. 24cm, for --rebound-to top")
        ->type_name("D");
    command
        .add_option("--reading-error", options.reading_error,
                    "Standard uncertainty of one reading in metres, or with --intervals in seconds "
                    "(default: from the scatter alone)")
        ->type_name("E");
}

void add_air(CLI::App& command, FitCommandOptions& options) {
    constexpr double kMost = 1e9;
    command.add_flag("--air", options.air,
                     "The ball was measured in air (default: as if in a vacuum)");
    command.add_option("--density", options.density, "Density of the air in kg/m^3")
        ->check(CLI::Range(1e-9, 1e4))
        ->type_name("D")
        ->capture_default_str();
    command
        .add_option("--ball", options.ball,
                    "The ball that flies: a preset, whose radius, mass and drag coefficient are "
                    "the defaults of the next three (default: none)")
        ->type_name("PRESET");
    command
        .add_option("--radius", options.radius,
                    "Radius of the ball in metres, or e.g. 20mm (default: --ball's)")
        ->type_name("R");
    command.add_option("--mass", options.mass, "Mass of the ball in kg (default: --ball's)")
        ->check(CLI::Range(1e-9, kMost))
        ->type_name("M");
    command.add_option("--drag", options.drag, "Drag coefficient of the ball (default: --ball's)")
        ->check(CLI::Range(1e-9, 1e3))
        ->type_name("C");
}

/// What else than one coefficient may be asked for; neither has a virtual body.
void add_laws(CLI::App& command, FitCommandOptions& options, CLI::Option& constant,
              CLI::Option& velocity) {
    auto* over_speed = command.add_flag(
        "--over-speed", options.over_speed,
        "A coefficient that falls with the speed, a power law, from drops of several heights "
        "(default: one for all)");
    auto* drag = command.add_flag(
        "--fit-drag", options.fit_drag,
        "The drag coefficient too, from the times between many bounces in --air (default: --drag, "
        "or --ball's)");
    for (auto* law : {over_speed, drag}) law->excludes(&constant)->excludes(&velocity);
    over_speed->excludes(drag);
}

}  // namespace

void add_fit_command(CLI::App& app, Run& run, const Interrupt& interrupt) {
    auto* command = app.add_subcommand(
        "fit", "From measured drops to a restitution, a line (x, v), a material");
    auto options = std::make_shared<FitCommandOptions>();
    command->footer(
        "  carom fit --drop 1.8 --rebound 1.29 --rebound 1.31\n"
        "  carom fit --drop 180cm --rebound 129cm -o line.svg\n"
        "  carom fit --intervals 0.86,0.73,0.62\n"
        "  carom fit --wav bounces.wav\n"
        "  carom fit --intervals 0.434,0.380,0.335 --air --ball table_tennis\n"
        "  carom fit --csv heights.csv --over-speed -o law.svg\n"
        "  carom fit --wav bounces.wav --air --ball table_tennis --fit-drag\n");
    add_sources(*command, *options);
    add_air(*command, *options);
    constexpr double kMost = 1e9;
    auto* constant = command->add_option("--constant", options->constant, "K of Eq. 7 in 1/s")
                         ->check(CLI::Range(1e-9, kMost))
                         ->type_name("K")
                         ->capture_default_str();
    auto* velocity = command
                         ->add_option("--velocity", options->velocity,
                                      "v of the suggested virtual body in m/s; x follows")
                         ->check(CLI::Range(1e-9, kMost))
                         ->type_name("V")
                         ->capture_default_str();
    command->add_option("--name", options->name, "Name of the material in the snippet")
        ->type_name("NAME")
        ->capture_default_str();
    command
        ->add_option("-o,--output", options->plot,
                     "Plot of the line: a .svg, .png or .pdf file (default: none)")
        ->type_name("PLOT");
    command->add_flag("-y,--overwrite", options->overwrite,
                      "Replace the plot (default: it is kept, exit code 4)");
    command->add_flag("--json", options->json, "Result as JSON");
    add_laws(*command, *options, *constant, *velocity);
    command->callback([options, &run, &interrupt] {
        run = [options, &interrupt] { return fit(*options, interrupt); };
    });
}

}  // namespace carom
