// All of the library: load or build a scene, simulate it, ask for states, draw and film it.
#pragma once

#include <carom/error.h>
#include <carom/film.h>
#include <carom/fit.h>
#include <carom/layers.h>
#include <carom/motion.h>
#include <carom/picture.h>
#include <carom/scene.h>
#include <carom/scene_builder.h>
#include <carom/second_run.h>
#include <carom/version.h>
