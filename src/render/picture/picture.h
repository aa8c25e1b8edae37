// What a painter draws: one picture again and again, of one run or of two.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/changed_parts.h"
#include "core/image.h"

namespace carom {

/// Something that may be drawn, and why it is or is not: for --stats.
struct DrawnEffect {
    bool on = false;
    std::string why;
};

class Picture {
  public:
    virtual ~Picture() = default;

    /// See Painter::paint_strobe(); one instant is blurred as the film's shutter says.
    virtual void paint(const std::vector<double>& instants, Image& out) = 0;

    /// See Painter.
    virtual ChangedParts paint_next(double t, Image& picture) = 0;

    virtual bool draws_each_anew() const = 0;

    virtual std::string renderer() = 0;  ///< name and version of the driver
    virtual std::map<std::string, DrawnEffect> effects() const = 0;

    /// CPU seconds since construction, see Painter.
    virtual double draw_cpu_s() const = 0;
    virtual double read_cpu_s() const = 0;
};

}  // namespace carom
