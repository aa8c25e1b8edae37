#include "report/paper.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include "core/check.h"
#include "core/diagnostics.h"
#include "core/failure.h"
#include "media/output_file.h"
#include "media/png.h"
#include "report/paper_figures.h"
#include "report/paper_pictures.h"
#include "report/paper_tables.h"
#include "scene/virtual_body.h"

namespace carom {

namespace {

PaperItem item(const std::string& name, const std::string& group,
               const std::vector<std::string>& endings) {
    PaperItem result{name, group, {}};
    for (const std::string& ending : endings) result.files.push_back(name + ending);
    return result;
}

bool fits(const PaperItem& item, const std::string& word) {
    return item.group == word || item.name == word ||
           item.name.substr(0, item.name.find('-')) == word;
}

/// What several items need is worked out once, when the first asks for it.
class PaperMaker {
  public:
    PaperMaker(std::string folder, Existing existing, const std::stop_token& stop,
               const std::function<void(const std::string&)>& report)
        : folder_(std::move(folder)), existing_(existing), stop_(stop), report_(report) {}

    void make(const PaperItem& item);

  private:
    const PaperRun& run_of(const std::string& scene) {
        const auto found = runs_.find(scene);
        if (found != runs_.end()) return found->second;
        return runs_.emplace(scene, run_paper_scene(scene, stop_)).first->second;
    }
    Drop drop() {
        const PaperRun& run = run_of("figure8");
        const Ball& ball = run.scene.balls.front();
        const auto material = static_cast<std::size_t>(ball.material);
        return {ball.position.z() - ball.radius,
                rigid_restitution(run.scene.materials[material].virtual_body,
                                  run.scene.simulation.restitution_constant),
                -run.scene.simulation.gravity.z()};
    }
    Figure figure(const std::string& name);
    TextTable table(const std::string& name);
    std::string path(const std::string& file) const {
        return (std::filesystem::path(folder_) / file).string();
    }
    void make_file(const PaperItem& item, const std::string& file);

    std::string folder_;
    Existing existing_;
    const std::stop_token& stop_;
    const std::function<void(const std::string&)>& report_;
    std::map<std::string, PaperRun> runs_;
};

Figure PaperMaker::figure(const std::string& name) {
    if (name == "figure1-3") return virtual_body_diagram();
    if (name == "figure4") return figure4();
    if (name == "figure5") return figure5();
    if (name == "figure6") return figure6();
    if (name == "figure7") return figure7();
    CAROM_CHECK(name, ==, std::string("figure8-height"));
    const PaperRun& run = run_of("figure8");
    return figure8_height(run.motion, run.scene.balls.front().radius, drop());
}

TextTable PaperMaker::table(const std::string& name) {
    if (name == "table1") return table1();
    if (name == "table2") return table2();
    if (name == "errata") return errata();
    CAROM_CHECK(name, ==, std::string("figure8-rebounds"));
    return figure8_rebounds(run_of("figure8").motion, drop());
}

void PaperMaker::make_file(const PaperItem& item, const std::string& file) {
    const std::string ending = std::filesystem::path(file).extension().string();
    if (item.group == "plots") {
        const Figure drawn = figure(item.name);
        if (ending == ".csv")
            write_text_file(path(file), csv_text(drawn.data), Durability::kUnsynced, existing_);
        else
            write_plot(drawn.plot, path(file), existing_, stop_);
    } else if (item.group == "tables") {
        const TextTable made = table(item.name);
        write_text_file(path(file), ending == ".md" ? markdown_text(made) : csv_text(made),
                        Durability::kUnsynced, existing_);
    } else if (item.group == "films") {
        film_motion(run_of(item.name), path(file), existing_, stop_);
    } else {
        const Image picture = item.name == "figure8" ? figure8_picture(run_of("figure8"))
                                                     : figure9_montage(run_of("figure9"));
        write_png(path(file), picture, PngEffort::kSmall, Durability::kUnsynced, existing_);
    }
    report_(file);
}

void PaperMaker::make(const PaperItem& item) {
    for (const std::string& file : item.files) {
        if (stop_.stop_requested())
            throw Failure(FailureKind::kRun, "interrupted before " + path(file));
        make_file(item, file);
    }
}

}  // namespace

std::vector<PaperItem> paper_items() {
    const std::vector<std::string> plot = {".svg", ".png", ".pdf", ".csv"};
    const std::vector<std::string> diagram = {".svg", ".png", ".pdf"};
    const std::vector<std::string> table = {".csv", ".md"};
    return {item("figure1-3", "plots", diagram),   item("figure4", "plots", plot),
            item("figure5", "plots", plot),        item("figure6", "plots", plot),
            item("figure7", "plots", plot),        item("table1", "tables", table),
            item("table2", "tables", table),       item("errata", "tables", table),
            item("figure8-height", "plots", plot), item("figure8-rebounds", "tables", table),
            item("figure8", "pictures", {".png"}), item("figure9-montage", "pictures", {".png"}),
            item("figure8", "films", {".mp4"}),    item("figure9", "films", {".mp4"})};
}

std::vector<PaperItem> choose_paper_items(const std::vector<std::string>& words) {
    const std::vector<PaperItem> all = paper_items();
    for (const std::string& word : words) {
        if (std::any_of(all.begin(), all.end(), [&](const PaperItem& i) { return fits(i, word); }))
            continue;
        std::vector<std::string> known = {"plots", "tables", "pictures", "films"};
        for (const PaperItem& i : all)
            if (std::find(known.begin(), known.end(), i.name) == known.end())
                known.push_back(i.name);
        throw Failure(FailureKind::kInput, fmt::format("nothing in the paper is called '{}'; there "
                                                       "are {}",
                                                       word, fmt::join(known, ", ")));
    }
    std::vector<PaperItem> chosen;
    for (const PaperItem& i : all)
        if (words.empty() || std::any_of(words.begin(), words.end(),
                                         [&](const std::string& word) { return fits(i, word); }))
            chosen.push_back(i);
    return chosen;
}

void make_paper(const std::vector<PaperItem>& items, const std::string& folder, Existing existing,
                const std::stop_token& stop,
                const std::function<void(const std::string&)>& report) {
    PaperMaker maker(folder, existing, stop, report);
    for (const PaperItem& item : items) maker.make(item);
}

}  // namespace carom
