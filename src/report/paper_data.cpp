#include "report/paper_data.h"

#include <array>

namespace carom {

namespace {

constexpr std::array<Table1Row, 5> kTable1 = {{
    {.ball = "basketball",
     .title = "Basketball",
     .mass_g = "567 - 650",
     .size_printed = "0.749 - 0.78 cm around",
     .size = "0.749 - 0.780 m around",
     .drop_m = 1.8,
     .low = PrintedRebound{"0.13", 1.30, 0.85, "0.13 m is 1.30 m"},
     .high = std::nullopt},
    {.ball = "volleyball",
     .title = "Volleyball",
     .mass_g = "260 - 280",
     .size_printed = "65 - 67 cm around",
     .size = "0.65 - 0.67 m around",
     .drop_m = 1.0,
     .low = PrintedRebound{"0.6", 0.60, 0.77, ""},
     .high = PrintedRebound{"0.66", 0.66, 0.81, ""}},
    {.ball = "football",
     .title = "Football",
     .mass_g = "420 - 445",
     .size_printed = "68.5 - 69.5 cm around",
     .size = "0.685 - 0.695 m around",
     .drop_m = 2.0,
     .low = PrintedRebound{"0.12", 1.20, 0.77, "0.12 m is 1.20 m"},
     .high = PrintedRebound{"1.65", 1.65, 0.9, ""}},
    {.ball = "tennis",
     .title = "Tennis",
     .mass_g = "56 - 59.4",
     .size_printed = "65.41 - 68.58 mm across",
     .size = "0.06541 - 0.06858 m across",
     .drop_m = 2.54,
     .low = PrintedRebound{"1.346 - 2.0", 1.346, 0.73, "1.346 - 2.0 is 1.346 m (53 in)"},
     .high = PrintedRebound{"1.473 - 2.0", 1.473, 0.76, "1.473 - 2.0 is 1.473 m (58 in)"}},
    {.ball = "table_tennis",
     .title = "Table tennis",
     .mass_g = "2.7",
     .size_printed = "40 mm across",
     .size = "0.040 m across",
     .drop_m = 0.305,
     .low = PrintedRebound{"0.24", 0.24, 0.89, ""},
     .high = PrintedRebound{"0.26", 0.26, 0.92, ""}},
}};

constexpr std::array<Table2Row, 4> kTable2 = {{
    {"basketball", "Basketball", 0.85, 5, 0.42},
    {"volleyball", "Volleyball", 0.78, 6, 0.72},
    {"football", "Football", 0.81, 3, 0.3},
    {"table_tennis", "Table tennis", 0.9, 1, 0.05},
}};

}  // namespace

std::span<const Table1Row> paper_table1() { return kTable1; }
std::span<const Table2Row> paper_table2() { return kTable2; }

}  // namespace carom
