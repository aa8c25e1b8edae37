// The gnuplot scripts, and gnuplot as a program.
#include "report/plot.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/failure.h"
#include "report/gnuplot.h"

namespace carom {
namespace {

namespace fs = std::filesystem;

class PlotTest : public ::testing::Test {
  protected:
    PlotTest() { fs::create_directories(folder_); }
    ~PlotTest() override { fs::remove_all(folder_); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    static std::string content(const std::string& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    }

    const fs::path folder_ =
        fs::temp_directory_path() / ("carom-plot-test-" + std::to_string(::getpid()));
};

Plot small_plot() {
    Plot plot;
    plot.title = "A & B's";
    plot.x = {.label = "time, s", .logarithmic = true, .min = 0.1, .max = 10};
    plot.y = {.label = "x_{A}, m"};
    plot.series = {{.title = "line", .x = {0.1, 1, 10}, .y = {1, 2, 3}},
                   {.title = "band",
                    .style = SeriesStyle::kBand,
                    .x = {0.1, 10},
                    .y = {0, 1},
                    .upper = {2, 4}},
                   {.title = "points", .style = SeriesStyle::kPoints, .x = {1}, .y = {2.5}}};
    return plot;
}

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST_F(PlotTest, ScriptHasDataAxesAndMarkup) {
    const std::string script = gnuplot_script(small_plot(), PlotFormat::kSvg, "it's.svg");
    EXPECT_TRUE(holds(script, "set output 'it''s.svg'"));
    EXPECT_TRUE(holds(script, "'A \\& B''s'")) << script;
    EXPECT_TRUE(holds(script, "'x_{A}, m'"));
    EXPECT_TRUE(holds(script, "set logscale x"));
    EXPECT_FALSE(holds(script, "set logscale y"));
    EXPECT_TRUE(holds(script, "set xrange [0.1:10]"));
    EXPECT_TRUE(holds(script, "set yrange [*:*]"));
    EXPECT_TRUE(holds(script, "$data0 << END\n0.1 1\n1 2\n10 3\nEND\n"));
    EXPECT_TRUE(holds(script, "$data1 << END\n0.1 0 2\n10 1 4\nEND\n"));
    EXPECT_TRUE(holds(script, "filledcurves"));
}

TEST_F(PlotTest, PlaceThatIsNoNumberLeavesAGap) {
    Plot plot = small_plot();
    plot.series = {{.title = "", .x = {1, 2, 3}, .y = {1, NAN, 3}}};
    const std::string script = gnuplot_script(plot, PlotFormat::kPng, "p.png");
    EXPECT_TRUE(holds(script, "1 1\n\n3 3\n"));
}

TEST_F(PlotTest, EachFormatIsItsOwnAndTheSameEachTime) {
    const struct {
        const char* name;
        const char* magic;
    } kFormats[] = {{"p.svg", "<?xml"}, {"p.png", "\x89PNG"}, {"p.pdf", "%PDF"}};
    for (const auto& format : kFormats) {
        write_plot(small_plot(), path(format.name));
        const std::string first = content(path(format.name));
        ASSERT_GT(first.size(), 1000U) << format.name;
        EXPECT_EQ(0U, first.find(format.magic)) << format.name;
        // A second later cairo would write another time into the PDF, but for our own.
        if (std::string(format.name) == "p.pdf") {
            EXPECT_TRUE(holds(first, "(D:20120601000000"));
        }
        write_plot(small_plot(), path(format.name));
        EXPECT_EQ(first, content(path(format.name))) << format.name;
    }
    EXPECT_TRUE(holds(content(path("p.svg")), "Inter, Helvetica"));
    EXPECT_FALSE(holds(content(path("p.svg")), "font-family=\"Inter\""));
}

TEST_F(PlotTest, DiagramNeedsNoData) {
    Plot plot;
    plot.title = "Diagram";
    plot.diagram = true;
    plot.x = {.label = "", .min = -2, .max = 2};
    plot.y = {.label = "", .min = -1, .max = 1};
    plot.circles = {{.x = 0, .y = 0, .radius = 0.5, .dashed = true, .fill = 0.2}};
    plot.arrows = {{-1, 0, 1, 0, 1, true}};
    plot.texts = {{0, 0.8, "C_{1}", true}};
    write_plot(plot, path("d.svg"));
    EXPECT_TRUE(holds(content(path("d.svg")), "Diagram"));
}

TEST_F(PlotTest, GnuplotsOwnWordsComeOut) {
    try {
        run_gnuplot("plot nonsense(x)\n", "drawing nothing");
        FAIL() << "no failure";
    } catch (const Failure& failure) {
        EXPECT_EQ(FailureKind::kRun, failure.kind());
        EXPECT_TRUE(holds(failure.what(), "drawing nothing")) << failure.what();
        EXPECT_TRUE(holds(failure.what(), "nonsense")) << failure.what();
    }
}

TEST_F(PlotTest, MissingGnuplotNamesThePackage) {
    const std::string before = std::getenv("PATH");
    setenv("PATH", folder_.c_str(), 1);
    try {
        write_plot(small_plot(), path("p.svg"));
        ADD_FAILURE() << "no failure";
    } catch (const Failure& failure) {
        EXPECT_EQ(FailureKind::kRun, failure.kind());
        EXPECT_TRUE(holds(failure.what(), "gnuplot-nox")) << failure.what();
    }
    setenv("PATH", before.c_str(), 1);
    EXPECT_FALSE(fs::exists(path("p.svg")));
}

TEST_F(PlotTest, OtherExtensionsAreRefused) {
    EXPECT_FALSE(plot_format_of("a.jpg"));
    try {
        write_plot(small_plot(), path("p.jpg"));
        FAIL() << "no failure";
    } catch (const Failure& failure) {
        EXPECT_EQ(FailureKind::kInput, failure.kind());
    }
}

}  // namespace
}  // namespace carom
