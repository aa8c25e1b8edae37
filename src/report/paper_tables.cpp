#include "report/paper_tables.h"

#include <algorithm>
#include <cmath>

#include "report/paper_data.h"
#include "scene/catalogue.h"
#include "scene/virtual_body.h"
#include "sim/contact/restitution.h"

namespace carom {

namespace {

constexpr int kHeightDecimals = 3, kRestitutionDecimals = 4;

/// Eq. 9.
double restitution_of_heights(double rebound_m, double drop_m) {
    return std::sqrt(rebound_m / drop_m);
}

/// Eq. 10 for a virtual body of distance x and velocity v.
double time_of(double distance, double velocity) { return virtual_time({distance, velocity}); }

void add_bound(TextTable& table, const Table1Row& row, const char* bound,
               const PrintedRebound& rebound) {
    const double computed = restitution_of_heights(rebound.height_m, row.drop_m);
    table.rows.push_back({row.title,
                          bound,
                          row.mass_g,
                          row.size_printed,
                          row.size,
                          {row.drop_m, kHeightDecimals},
                          rebound.text,
                          {rebound.height_m, kHeightDecimals},
                          {rebound.restitution, 2},
                          {computed, kRestitutionDecimals},
                          {computed - rebound.restitution, kRestitutionDecimals},
                          rebound.erratum});
}

struct TennisRow {
    VirtualBody body;
    double reference = 0;  ///< the middle of Table 1
};

/// Table 2 leaves tennis out; the catalogue's virtual body is chosen for the middle of Table 1.
TennisRow tennis() {
    for (const Table1Row& row : paper_table1())
        if (row.ball == "tennis")
            return {find_preset("tennis")->virtual_body,
                    0.5 * (row.low->restitution + row.high->restitution)};
    return {};
}

}  // namespace

TextTable table1() {
    TextTable table;
    table.columns = {{"ball", "Ball"},
                     {"bound", "Bound"},
                     {"mass_g", "Mass [g]"},
                     {"size_printed", "Size, printed"},
                     {"size", "Size, corrected"},
                     {"drop_m", "Drop [m]"},
                     {"rebound_printed", "Rebound, printed"},
                     {"rebound_m", "Rebound, corrected [m]"},
                     {"restitution_printed", "ε, printed"},
                     {"restitution", "ε = √(h/H)"},
                     {"deviation", "Deviation"},
                     {"erratum", "Erratum"}};
    for (const Table1Row& row : paper_table1()) {
        if (row.low) add_bound(table, row, "low", *row.low);
        if (row.high) add_bound(table, row, "high", *row.high);
    }
    return table;
}

TextTable table2() {
    TextTable table;
    table.columns = {{"ball", "Ball"},
                     {"restitution_printed", "ε, printed"},
                     {"distance_printed", "x, printed"},
                     {"velocity_printed", "v, printed"},
                     {"time_printed_s", "T as printed [s]"},
                     {"constant_needed", "K it would need [1/s]"},
                     {"distance_m", "x, exchanged [m]"},
                     {"velocity_m_s", "v, exchanged [m/s]"},
                     {"time_s", "T [s]"},
                     {"restitution", "ε at K = 4"},
                     {"deviation", "Deviation"}};
    for (const Table2Row& row : paper_table2()) {
        const double printed_time = time_of(row.printed_distance, row.printed_velocity);
        const double time = time_of(row.printed_velocity, row.printed_distance);
        const double restitution = restitution_of_time(time, kPaperConstant);
        table.rows.push_back({row.title,
                              {row.restitution, 2},
                              {row.printed_distance, 2},
                              {row.printed_velocity, 2},
                              {printed_time, 3},
                              {-std::log(row.restitution) / printed_time, 4},
                              {row.printed_velocity, 2},
                              {row.printed_distance, 2},
                              {time, 3},
                              {restitution, kRestitutionDecimals},
                              {restitution - row.restitution, kRestitutionDecimals}});
    }
    const TennisRow derived = tennis();
    const double restitution = rigid_restitution(derived.body, kPaperConstant);
    table.rows.push_back({"Tennis (derived)",
                          {derived.reference, 3},
                          "",
                          "",
                          "",
                          "",
                          {derived.body.distance_m, 3},
                          {derived.body.velocity_m_s, 2},
                          {virtual_time(derived.body), 4},
                          {restitution, kRestitutionDecimals},
                          {restitution - derived.reference, kRestitutionDecimals}});
    return table;
}

SingleConstant best_constant_as_printed() {
    const auto worst = [](double constant) {
        double deviation = 0;
        for (const Table2Row& row : paper_table2()) {
            const double time = time_of(row.printed_distance, row.printed_velocity);
            deviation = std::max(deviation,
                                 std::abs(restitution_of_time(time, constant) - row.restitution));
        }
        return deviation;
    };
    // The largest of functions of K that first fall and then rise does the same: thirds close in on
    // its lowest point, from the whole range of the constants that single rows need.
    double low = 1e-3, high = 1;
    while (high - low > 1e-9) {
        const double third = (high - low) / 3;
        if (worst(low + third) < worst(high - third))
            high -= third;
        else
            low += third;
    }
    return {0.5 * (low + high), worst(0.5 * (low + high))};
}

}  // namespace carom
