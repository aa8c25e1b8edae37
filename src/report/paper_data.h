// What the paper prints, and what it must have meant: the one place of all its numbers.
//
// T. Khurelbaatar, D. Enkhzul, T. Amartuvshin, B. Sukhbat, "The Graphical Method for Decision of
// Restitution Coefficient and Its Applications", Journal of Software Engineering and Applications
// 5(6), 2012, 429-435, doi:10.4236/jsea.2012.56049.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace carom {

/// K of Eq. 7 that makes Table 2 true once its columns are exchanged, 1/s. The paper names none.
inline constexpr double kPaperConstant = 4;

/// One bound of a rebound in Table 1.
struct PrintedRebound {
    std::string_view text;     ///< as printed, m
    double height_m = 0;       ///< as meant
    double restitution = 0;    ///< as printed
    std::string_view erratum;  ///< why the two differ; empty where they agree
};

/// A row of Table 1.
struct Table1Row {
    std::string_view ball;  ///< the preset
    std::string_view title;
    std::string_view mass_g;        ///< as printed
    std::string_view size_printed;  ///< with the unit of the column's heading
    std::string_view size;          ///< as meant
    double drop_m = 0;
    std::optional<PrintedRebound> low;
    std::optional<PrintedRebound> high;
};
std::span<const Table1Row> paper_table1();

/// A row of Table 2, as printed: the heading "Distance" stands over what is the speed.
struct Table2Row {
    std::string_view ball;
    std::string_view title;
    double restitution = 0;
    double printed_distance = 0;
    double printed_velocity = 0;
};
std::span<const Table2Row> paper_table2();

/// The body that the other one meets in Figures 5 and 6, where the paper fixes x_B and v_B without
/// naming them: here the basketball of Table 2 (columns exchanged).
inline constexpr double kFixedDistance_m = 0.42;
inline constexpr double kFixedVelocity_m_s = 5;

/// Figure 7's coefficient, the basketball's of Table 1 and 2.
inline constexpr double kFigure7Restitution = 0.85;

/// FIBA's rule of the paper's time (Official Basketball Rules 2010, reference 8 of the paper): from
/// 1.80 m measured at the ball's bottom, a rebound of 1.20 to 1.40 m measured at its top.
inline constexpr double kFibaDrop_m = 1.80;
inline constexpr double kFibaReboundTop_m[] = {1.20, 1.40};

}  // namespace carom
