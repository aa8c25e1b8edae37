// The markings of balls as pictures, for programs that draw them themselves.
#pragma once

#include "core/image.h"
#include "render/gl/offscreen.h"
#include "scene/scene.h"

namespace carom {

/// True where a ball of this look has markings; else it is all of one colour.
bool has_markings(const Look& look);

/// The markings of a look over the ball's longitude (columns, -pi at the left edge, counted from
/// the ball's x axis towards y) and latitude (rows, the pole of z on top), opaque. Drawn by the
/// shader of films, so that they are the same. Failure(kRun) as painters have it.
class BallTextures {
  public:
    static constexpr int kWidth = 512, kHeight = 256;  ///< px

    Image draw(const Look& look);

  private:
    OffscreenContext context_;
};

}  // namespace carom
