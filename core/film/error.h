// How wrong a picture is, told from its two halves alone.
//
// With a half's errors a and b in a pixel, the picture is off by (a + b) / 2 there, and the halves differ by a - b. As
// ((a + b) / 2)^2 - ((a - b) / 2)^2 = a b, which is zero in expectation, the mean of ((a - b) / 2)^2 over pixels is an
// estimate of the mean squared error; and what it misses is the mean of a b, whose variance is that of a times that of
// b however long the tails of either are. From there comes the interval: for the error of this very picture, not for
// that of all pictures made in the same way.
#pragma once
#include <span>

namespace etendue::film {

// Within its ends lies, in 95 of 100 cases, what was estimated.
struct Interval {
  double low = 0, high = 0;
};

struct ErrorEstimate {
  double rmse = 0;  // of the mean image, over pixels and channels
  Interval rmse_interval;
  // A rough one without an interval: it divides by the picture where relMSE divides by the truth, and is up to a third
  // too low. To state one, see relative_error.h, which takes longer.
  double approximate_relmse = 0;
  // By how much the RMSE of another picture, made in the same way with other random numbers, differs from this one's: a
  // standard deviation in parts of it. About 1/2 where a few pixels make all of the error.
  double rmse_variation = 0;
  bool known = false;  // false until every pixel has a sample in both halves
};

// The sums of one row of pixels: made in parallel, added in the order of the rows.
struct RowError {
  // Estimated squared errors of the pixels, summed over channels, their share of the interval, and their squares.
  struct Sum {
    double squares = 0, spread = 0, fourth = 0;
  };
  Sum absolute;
  double relative = 0;  // squares, over the picture's own
  bool known = true;
};

// `numbers` is pixels times channels.
ErrorEstimate error_of(std::span<const RowError> rows, double numbers);

// Adds up one kind of squared error along a row.
//
// The spread of a b over a pixel is the square of that pixel's squared error in expectation. One pixel alone has two
// numbers to tell it from, and its own square would count long tails as well; neighbours are alike and independent, so
// their product stands for both.
class RowSum {
 public:
  explicit RowSum(RowError::Sum& sum) : sum_(sum) {}
  // The next pixel's estimated squared error, channels added up: they err together at worst, and are taken to.
  void add(double squared_error);

 private:
  RowError::Sum& sum_;
  double pixels_ = 0, products_ = 0, before_ = 0;
};

}  // namespace etendue::film
