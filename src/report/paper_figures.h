// The paper's figures that are plots, as values with the numbers behind them.
//
// The text of the paper names no ranges of the axes, no K and no constants of Figures 5 and 6; the
// choices here show the curves (paper_data.h), and docs/paper.md says so.
#pragma once

#include <string>

#include "motion/motion.h"
#include "report/plot.h"
#include "report/text_table.h"

namespace carom {

struct Figure {
    Plot plot;
    TextTable data;  ///< the same numbers; no columns where the figure has none
};

/// The idea of Figures 1-3: real and virtual bodies before, at and after contact. A diagram.
Figure virtual_body_diagram();

Figure figure4();  ///< ε against T, Eq. 7
Figure figure5();  ///< ε against v_A for three x_A, Eq. 6 and 7
Figure figure6();  ///< ε against x_A for three v_A
Figure figure7();  ///< v against x for the basketball: the graphical method

/// A ball dropped from rest onto a level floor, without air: closed forms.
struct Drop {
    double height_m = 0;
    double restitution = 0;
    double gravity_m_s2 = 9.81;

    double fall_s() const;               ///< until the first impact
    double height_at(double t) const;    ///< gap under the ball, m
    double rebound_m(int n) const;       ///< ε^(2n) H
    double rebound_time_s(int n) const;  ///< of the n-th top, n = 1 ...
};

/// Figure 8: the first ball's gap over its floor against time, the closed form over it. The motion
/// starts at rest at `drop.height_m`.
Figure figure8_height(const Motion& motion, double radius_m, const Drop& drop);

/// The tops of Figure 8, simulated and in closed form.
TextTable figure8_rebounds(const Motion& motion, const Drop& drop);

}  // namespace carom
