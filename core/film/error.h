// Estimation of the error of an image from its two half-buffers
//
// Let a and b be the errors of the two half-buffers in a pixel. The error of the image is (a + b) / 2, and the difference
// of the half-buffers is a - b. Since
//
//   ((a + b) / 2)^2 - ((a - b) / 2)^2 = a b,
//
// and a b has the expected value zero, the mean of ((a - b) / 2)^2 over the pixels is an unbiased estimate of the mean
// squared error. The deviation of the estimate from the realised error is the mean of a b. Its variance is the product of
// the variances of a and b, however heavy-tailed they are. The confidence interval follows from this variance. It is an
// interval for the error of this image, not for the expected error of images made in the same way.
#pragma once
#include <span>

namespace etendue::film {

// A 95 % confidence interval.
struct Interval {
  double low = 0, high = 0;
};

struct ErrorEstimate {
  double rmse = 0;  // root mean squared error of the mean image, over pixels and channels
  Interval rmse_interval;
  // Without confidence interval. Divides by the squared pixel value of the image instead of the true one, and is up to a
  // third too low. relative_error.h has a better estimate, which takes longer.
  double approximate_relmse = 0;
  // The standard deviation of the RMSE over images made in the same way with other random numbers, divided by the RMSE.
  // About 1/2 if few pixels dominate the error.
  double rmse_variation = 0;
  // False until every pixel has a sample in both half-buffers, and for a black image, whose lack of noise says nothing.
  bool known = false;
};

// Sums over one row of pixels. Rows can be computed in parallel and are added in order.
struct RowError {
  struct Sum {
    double squares = 0;   // estimated squared errors of the pixels, summed over channels
    double variance = 0;  // of the deviation of `squares` from the realised squared errors, divided by 4
    double fourth = 0;    // squares of the squared errors
  };
  Sum absolute;
  double relative = 0;  // squared errors divided by the squared pixel values
  bool known = true;
  bool has_light = false;  // a pixel is not black
};

// `values` is the number of pixels times the number of channels.
ErrorEstimate error_of(std::span<const RowError> rows, double values);

// Accumulates the squared errors along a row.
//
// The variance of a b in a pixel has the expected value of the square of the squared error. A single pixel provides only
// two numbers for it, and the square of its estimate would overrate heavy tails. Neighbouring pixels are similar and
// independent, so that the product of their squared errors is used for both.
class RowSum {
 public:
  explicit RowSum(RowError::Sum& sum) : sum_(sum) {}
  // Adds the estimated squared error of the next pixel, summed over channels. The errors of channels are assumed to be
  // fully correlated, which is the worst case.
  void add(double squared_error);

 private:
  RowError::Sum& sum_;
  double pixels_ = 0, products_ = 0, previous_ = 0;
};

}  // namespace etendue::film
