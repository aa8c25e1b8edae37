// What `carom compare` has found so far: counts, the first and the worst pair.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"

namespace carom {

class Comparison {
  public:
    /// `what` is the plural of what is compared: "pictures" or "frames".
    Comparison(const ImageTolerance& tolerance, std::string what)
        : tolerance_(tolerance), what_(std::move(what)) {}

    void add(const std::string& name, const Image& a, const Image& b);
    /// A frame that the films show at different times, in seconds after their first ones.
    void add_other_time(const std::string& name, double a_s, double b_s);
    void add_missing(const std::string& name);  ///< in one of them only

    bool same() const { return failed_.empty(); }
    std::int64_t compared() const { return compared_; }
    /// The difference of the worst pair of equal size; empty without one.
    const Image& worst_picture() const { return picture_; }

    /// A line that says how many differ, and one each for the first and the worst.
    std::string text() const;
    nlohmann::ordered_json json() const;

  private:
    /// One pair, and what is wrong with it.
    struct Found {
        std::string name;
        ImageDifference difference;
    };
    void fail(const std::string& name, const std::string& why);

    ImageTolerance tolerance_;
    std::string what_;
    std::int64_t compared_ = 0;
    std::int64_t missing_ = 0;
    std::int64_t other_times_ = 0;
    std::vector<std::string> failed_;  ///< names, each once, in order
    std::string first_;                ///< the first failure, with its reason
    std::optional<Found> worst_;       ///< of all that were compared
    Image picture_;
};

}  // namespace carom
