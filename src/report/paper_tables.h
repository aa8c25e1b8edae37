// Tables 1 and 2 of the paper: printed, corrected and computed side by side; and its errata.
#pragma once

#include "report/text_table.h"

namespace carom {

/// One row per bound: the printed and the corrected rebound, and Eq. 9 of the latter.
TextTable table1();

/// As printed (T, and the K that each row would need), then with the columns exchanged and K = 4.
/// Tennis, which Table 2 leaves out, is derived from Table 1.
TextTable table2();

/// The constant that fits Table 2 as printed best, and how far off it stays.
struct SingleConstant {
    double constant = 0;   ///< K, 1/s
    double deviation = 0;  ///< the largest of any row's coefficient
};
SingleConstant best_constant_as_printed();

/// Each mistake with what it must be and the arithmetic that shows it.
TextTable errata();

}  // namespace carom
