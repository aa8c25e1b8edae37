// A sweep from text, for tests.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "core/temporary_folder.h"
#include "sweep/file/plan.h"
#include "sweep/file/sweep_file.h"

namespace carom {

/// A ball 1 m above a floor, that keeps 0.8 of its speed.
inline constexpr const char* kBase = R"(carom: 1
simulation: {duration: 2, gravity: [0, 0, -10]}
materials:
  rubber: {restitution: 0.8}
surfaces:
  - {name: floor, plane: {normal: [0, 0, 1], offset: 0}}
balls:
  - {name: a, radius: 0.1, mass: 2, material: rubber, position: [0, 0, 1.1]}
film: {size: [64, 64], fps: 20}
)";

/// Files in a folder that goes with it.
class SweepFiles {
  public:
    explicit SweepFiles(const std::string& sweep, const std::string& base = kBase)
        : folder_(FailureKind::kRun) {
        std::ofstream(folder_.file("base.yaml")) << base;
        std::ofstream(folder_.file("sweep.yaml")) << sweep;
    }
    SweepResult read() const { return read_sweep_file(folder_.file("sweep.yaml"), {}); }
    /// Of a file that is right.
    Sweep sweep() const {
        SweepResult result = read();
        for (const Diagnostic& one : result.diagnostics.items()) ADD_FAILURE() << one.text();
        return std::move(result.sweep.value());
    }
    /// "2:3: message", a line each.
    std::string mistakes() const {
        std::string text;
        const SweepResult result = read();
        for (const Diagnostic& one : result.diagnostics.items())
            text += std::to_string(one.mark.line) + ":" + std::to_string(one.mark.column) + ": " +
                    one.message + "\n";
        return text;
    }
    std::string folder() const { return folder_.path().string(); }

  private:
    TemporaryFolder folder_;
};

}  // namespace carom
