// Angle of view and lens radius in the terms of photography: focal length, f-number and height of the sensor.
//
// A lens focused at infinity has its sensor at the focal length f. A sensor of height h then sees the angle
// 2 atan(h / (2 f)), and the f-number is f divided by the diameter of the aperture.
#pragma once
#include <cmath>

namespace etendue {

// The height of a full-frame sensor of 36 x 24 mm, in millimetres.
inline constexpr double kFullFrameHeight = 24;

// In the unit of the sensor height; `angle` is the vertical angle of view in radians, 0 to pi.
inline double focal_length(double angle, double sensor_height) { return 0.5 * sensor_height / std::tan(0.5 * angle); }
// In radians.
inline double angle_of_view(double focal_length, double sensor_height) {
  return 2 * std::atan(0.5 * sensor_height / focal_length);
}

// 0 for a pinhole, whose f-number is infinite. Both lengths have the same unit.
inline double f_number(double focal_length, double lens_radius) {
  return lens_radius > 0 ? focal_length / (2 * lens_radius) : 0;
}
// The radius of the lens; 0 for the f-number 0, which stands for a pinhole.
inline double lens_radius(double focal_length, double f_number) {
  return f_number > 0 ? focal_length / (2 * f_number) : 0;
}

}  // namespace etendue
