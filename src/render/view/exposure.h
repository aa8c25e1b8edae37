// Motion blur: which instants of the motion one picture averages.
#pragma once

#include <vector>

#include "motion/motion.h"
#include "render/view/camera.h"
#include "scene/scene.h"

namespace carom {

/// More instants than this are not drawn for one picture. Up to as many pixels of way in the time
/// that the shutter is open, neighbouring instants are at most kExposureStepPx apart and edges blur
/// without steps; a ball that is faster leaves steps of 1/128 of the contrast.
inline constexpr int kMostInstants = 128;
inline constexpr double kExposureStepPx = 1.0;
/// A short way has finer steps, up to that many: few instants leave more of each in the mean.
inline constexpr double kFineStepPx = 0.5, kFewestInstants = 4, kFineInstants = 16;
/// Less way than this needs no blur.
inline constexpr double kLeastBlurPx = 0.25;

/// Where the shutter is open around the motion's instant t: shutter_deg / 360 of the time between
/// two frames, in film time, half of it before t and half after, as far as the motion goes from 0
/// to `duration`. `at(x)` for x in 0 ... 1 is the instant at that part of the film time.
class Exposure {
  public:
    Exposure(const Film& film, double duration, double t);
    double at(double part) const;

  private:
    Film film_;                   ///< with start at 0
    double open_ = 0, shut_ = 0;  ///< film time
    double longest_;
};

/// How many instants to draw of what comes so far in the picture, px; 1 where no blur is needed.
int exposure_count(double way_px);

/// A moving ball is drawn with its way in each of so many parts of the time, edges and markings
/// filtered along it, so that one stands for several instants; `count` of them would be drawn of
/// what stands still before a camera that moves.
int sweep_count(int count);

/// `count` instants, each for an equal part of the film time and in its middle.
std::vector<double> exposure_instants(const Exposure& exposure, int count);

/// How far a ball comes while the shutter is open, px, with the way of a point on its equator if it
/// spins and has markings.
struct BallWay {
    double seen = 0;  ///< of it, within the picture
    double all = 0;   ///< also beside the picture, from where its shadow may reach into it
};
std::vector<BallWay> ball_ways_px(const Scene& scene, const Motion& motion,
                                  const Exposure& exposure, const View& view);

/// How far what stands still comes in the picture, px, when `camera` moves.
double camera_way_px(const Camera& camera, const Motion& motion, const Exposure& exposure,
                     int width_px, int height_px);

}  // namespace carom
