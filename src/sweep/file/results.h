// What is measured of a run: expressions of its motion, such as peak("a", 1).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "motion/motion.h"
#include "scene/scene.h"
#include "sweep/file/sweep_file.h"

namespace carom {

/// A function of expressions, or a number that has a name.
struct ResultFunction {
    const char* example;
    const char* unit;
    const char* meaning;
};
const std::vector<ResultFunction>& result_functions();

/// All of them in Markdown, as they stand in docs/sweeps.md.
std::string result_reference_markdown();

/// Names that may stand in expressions.
struct ResultNames {
    std::vector<std::string> balls, surfaces;
    std::vector<std::string> drawn;  ///< how names of balls begin that are drawn for each run
};

/// Why this is no expression, "" for one that is.
std::string wrong_expression(const std::string& expression, const ResultNames& known);

/// Parsed once, evaluated for many runs; each thread has its own.
class ResultTable {
  public:
    explicit ResultTable(const std::vector<ResultSpec>& specs);
    ~ResultTable();
    ResultTable(const ResultTable&) = delete;
    ResultTable& operator=(const ResultTable&) = delete;

    /// In the order of `specs`; none where the motion has no such thing (a third peak of two).
    /// Failure(kRun) for what cannot be evaluated, such as a ball that this scene has not.
    std::vector<std::optional<double>> evaluate(const Scene& scene, const Motion& motion);

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

/// Versions of the libraries that this folder names.
std::string expression_library_version();

}  // namespace carom
