// What was measured of a ball: drops and rebounds, or the times between its bounces.
#pragma once

#include <string>
#include <vector>

namespace carom {

/// One drop, as it was measured, m.
struct MeasuredDrop {
    double drop_m = 0;     ///< of the ball's bottom over the floor
    double rebound_m = 0;  ///< of its bottom, or of its top
    std::string where;     ///< for messages: "drops.csv:3", "--drop 1.8"
};

/// Either drops, or the times between successive bounces in order (s).
struct Measurements {
    std::vector<MeasuredDrop> drops;
    std::vector<double> intervals_s;
};

enum class Quantity { kLength, kTime };

/// "1.8", "180cm", "70.9 in", "512 ms" in metres or seconds; without a unit it is one of those.
/// `where` stands in front of the message. Throws Failure(kInput) for anything else.
double parse_quantity(const std::string& text, Quantity quantity, const std::string& where);

/// A CSV file with the columns drop and rebound, or with the column interval, each with its unit in
/// the header: "drop [cm]", "drop (cm)" or "drop_cm". Commas, semicolons or tabs; '#' begins a line
/// of comment. Throws Failure(kInput) as FILE:LINE: message.
Measurements read_measurements(const std::string& path);

}  // namespace carom
