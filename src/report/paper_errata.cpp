// The paper's mistakes, each with its arithmetic; declared in paper_tables.h.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/check.h"
#include "report/paper_data.h"
#include "report/paper_tables.h"
#include "scene/catalogue.h"
#include "sim/contact/restitution.h"

namespace carom {

namespace {

struct Erratum {
    std::string where, printed, meant, arithmetic;
};

const Table1Row& row_of(std::string_view ball) {
    for (const Table1Row& row : paper_table1())
        if (row.ball == ball) return row;
    throw Bug("Table 1 has no such ball");
}

std::string root_of(double rebound, double drop) {
    return fmt::format("√({} / {}) = {:.3f}", rebound, drop, std::sqrt(rebound / drop));
}

Erratum exchanged_columns() {
    std::string times, constants, restitutions;
    double worst = 0;
    for (const Table2Row& row : paper_table2()) {
        const double printed = virtual_time({row.printed_distance, row.printed_velocity});
        const double time = virtual_time({row.printed_velocity, row.printed_distance});
        const double restitution = restitution_of_time(time, kPaperConstant);
        const char* comma = times.empty() ? "" : ", ";
        times += fmt::format("{}{:.3f}", comma, printed);
        constants += fmt::format("{}{:.4f}", comma, -std::log(row.restitution) / printed);
        restitutions += fmt::format("{}{:.4f}", comma, restitution);
        worst = std::max(worst, std::abs(restitution - row.restitution));
    }
    const SingleConstant single = best_constant_as_printed();
    return {"Table 2", "x_A = 5, v = 0.42 (basketball) and so on",
            "x_A = 0.42 m, v = 5 m/s and so on, with K = 4",
            fmt::format("As printed T = x/(2v) = {} s: the larger T, the larger ε, and Eq. 7 needs "
                        "K = {}, one for each row; the best single K, {:.4f}, is off by {:.3f}. "
                        "Exchanged, K = 4 gives {}, off by at most {:.4f}",
                        times, constants, single.constant, single.deviation, restitutions, worst)};
}

Erratum basketball() {
    const Table1Row& row = row_of("basketball");
    return {"Table 1, basketball", "rebound 0.13 m, circumference 0.749 - 0.78 cm",
            "1.30 m, 0.749 - 0.780 m",
            fmt::format("{}, the printed {}; a circumference of 0.78 cm is a ball of {:.1f} mm, "
                        "one of 0.78 m is {:.1f} cm wide",
                        root_of(row.low->height_m, row.drop_m), row.low->restitution,
                        7.8 / std::numbers::pi, 78 / std::numbers::pi)};
}

Erratum football() {
    const Table1Row& row = row_of("football");
    return {"Table 1, football", "rebound 0.12 m", "1.20 m",
            fmt::format("{}, printed {}; {}, printed {}", root_of(row.low->height_m, row.drop_m),
                        row.low->restitution, root_of(row.high->height_m, row.drop_m),
                        row.high->restitution)};
}

Erratum tennis() {
    const Table1Row& row = row_of("tennis");
    const VirtualBody& body = find_preset("tennis")->virtual_body;
    return {
        "Table 1 and 2, tennis", "rebound 1.346 - 2.0 and 1.473 - 2.0; not in Table 2",
        "1.346 m and 1.473 m; x = 0.736 m, v = 5 m/s",
        fmt::format("53 in = {:.3f} m, 58 in = {:.3f} m; {}, {}; the middle of the printed "
                    "ones is {}, and exp(−4 · {} / (2 · {})) = {:.4f}",
                    53 * 0.0254, 58 * 0.0254, root_of(row.low->height_m, row.drop_m),
                    root_of(row.high->height_m, row.drop_m),
                    0.5 * (row.low->restitution + row.high->restitution), body.distance_m,
                    body.velocity_m_s, restitution_of_time(virtual_time(body), kPaperConstant))};
}

Erratum sign() {
    return {"Eq. 3", "v⁺ = ε v⁻", "v⁺ = −ε v⁻",
            "ε = 1 must give v⁺ = −v⁻, as the text below the equation says; without the sign it "
            "gives v⁺ = v⁻: the bodies pass through each other"};
}

Erratum lossless_body() {
    return {"Text under Eq. 7", "a lossless body has x = 0 and v = 0", "x = 0, whatever v",
            fmt::format("x = v = 0 makes Eq. 6 0/0; x = 0, v = 1 makes T = {} and ε = {}",
                        virtual_time({0, 1}),
                        restitution_of_time(virtual_time({0, 1}), kPaperConstant))};
}

Erratum unlike_heights() {
    const double diameter = 2 * find_preset("basketball")->radius;
    const auto bottom = [&](double top) { return top - diameter; };
    const double low = bottom(kFibaReboundTop_m[0]), high = bottom(kFibaReboundTop_m[1]);
    return {"Table 1, basketball's ε", "0.85",
            "0.73 - 0.80 (carom's basketball keeps the paper's 0.845)",
            fmt::format("The rule measured the drop at the ball's bottom and the rebound, "
                        "{:.2f} - {:.2f} m, at its top, {:.3f} m higher: bottom to bottom it is "
                        "{:.2f} - {:.2f} m, ε = √(h / {}) = {:.2f} - {:.2f}",
                        kFibaReboundTop_m[0], kFibaReboundTop_m[1], diameter, low, high,
                        kFibaDrop_m, std::sqrt(low / kFibaDrop_m), std::sqrt(high / kFibaDrop_m))};
}

}  // namespace

TextTable errata() {
    TextTable table;
    table.columns = {{"number", "No."},
                     {"where", "Where"},
                     {"printed", "Printed"},
                     {"meant", "Meant"},
                     {"arithmetic", "Arithmetic"}};
    int number = 0;
    for (const Erratum& erratum : {exchanged_columns(), basketball(), football(), tennis(), sign(),
                                   lossless_body(), unlike_heights()})
        table.rows.push_back({{static_cast<double>(++number), 0},
                              erratum.where,
                              erratum.printed,
                              erratum.meant,
                              erratum.arithmetic});
    return table;
}

}  // namespace carom
