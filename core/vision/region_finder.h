#pragma once
// Finds where the target is in a template when nobody said: the square window whose gradients point into all directions
// most strongly (largest smaller eigenvalue of the structure tensor, as in Shi and Tomasi, CVPR 1994), and where that
// shows a single thing, all of it with a little of what is around.

#include <string>

#include "core/base/result.h"
#include "core/vision/image.h"

namespace zerodrift::vision {

/// `beside`: what is there is not looked at. Errors: template_without_texture.
Result<Region> find_textured_region(const GrayImage& image, const std::string& name, const Region* beside = nullptr);

}  // namespace zerodrift::vision
