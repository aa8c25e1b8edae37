// Steps between the marks of a scale.
#pragma once

namespace carom {

/// The smallest of 1, 2, 5 times a power of ten that is at least `least`, which is above 0.
double step_at_least(double least);

/// The largest of them that is at most `most`, which is above 0.
double step_at_most(double most);

}  // namespace carom
