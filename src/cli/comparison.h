// What `carom compare` has found so far: counts, the first and the worst pair, measures of each.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/image_measures.h"

namespace carom {

class Comparison {
  public:
    /// `what` is the plural of what is compared: "pictures" or "frames". `keeps_picture`: the
    /// difference of the worst pair is wanted.
    Comparison(const ImageTolerance& tolerance, std::string what, bool keeps_picture)
        : tolerance_(tolerance), what_(std::move(what)), keeps_picture_(keeps_picture) {}

    /// `difference` makes the pair's difference_image(); it is asked at once, if at all.
    void add(const std::string& name, const ImageMeasures& measures,
             const std::function<Image()>& difference);
    /// A frame that the films show at different times, in seconds after their first ones.
    void add_other_time(const std::string& name, double a_s, double b_s);
    void add_missing(const std::string& name);  ///< in one of them only

    bool same() const { return failed_.empty(); }
    std::int64_t compared() const { return static_cast<std::int64_t>(pairs_.size()); }
    /// The difference of the worst pair of equal size; empty without one, or where none is wanted.
    const Image& worst_picture() const { return picture_; }

    /// A line that says how many differ, and one each for the first and the worst.
    std::string text() const;
    nlohmann::ordered_json json() const;

  private:
    /// One pair, and how far it is apart.
    struct Pair {
        std::string name;
        ImageMeasures measures;
    };
    void fail(const std::string& name, const std::string& why);
    const Pair* first_not_identical() const;

    ImageTolerance tolerance_;
    std::string what_;
    bool keeps_picture_;
    std::int64_t missing_ = 0;
    std::int64_t other_times_ = 0;
    std::vector<Pair> pairs_;           ///< all that were compared, in order
    std::vector<std::string> failed_;   ///< names, each once, in order
    std::string first_;                 ///< the first failure, with its reason
    std::optional<std::size_t> worst_;  ///< of pairs_
    Image picture_;
};

}  // namespace carom
