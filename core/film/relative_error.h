// relMSE of a picture, the mean of (x - r)^2 / (r^2 + 0.01) over pixels and channels, told without the truth r.
//
// The squared error above the line is told from the halves (error.h). Below it stands the true radiance. A pixel's own
// mean will not do for that: where noise is a few bright samples, it is highest where it errs most, and relMSE comes
// out a third too low. So r is told from others: the mean of the pixels around whose own eight neighbours look like
// this pixel's within their noise, like non-local means (Buades et al. 2005; noise as in Rousselle et al. 2012). What
// the pixel itself happened to become has no say in who is like it, and hardly any in the mean.
//
// The interval is for the error of this very picture. It holds three things: what the halves miss of the realised
// error, as in error.h, with alike pixels standing for each other; what noise in the mean of the others does; and how
// far the estimate would move if the pixel's own mean counted as much as any other, for what is alike and yet not the
// same.
#pragma once
#include <optional>
#include <span>

#include "film/film.h"

namespace etendue::film {

struct RelativeError {
  double relmse = 0;
  Interval interval;
};

// `rgb` and `variance`, of its mean, hold three numbers a pixel. Takes 0.7 us a pixel, about.
RelativeError relative_error(int width, int height, std::span<const float> rgb, std::span<const float> variance);

// Nothing until every pixel has a sample in both halves.
std::optional<RelativeError> relative_error(const Film& film);

}  // namespace etendue::film
