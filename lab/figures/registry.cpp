// The registry of figures: one line each, by chapter and number.
#include <algorithm>

#include "figures/figure.h"

// clang-format off
#define ETENDUE_FIGURES(ENTRY) \
  ENTRY(1, 2) \
  ENTRY(1, 3) \
  ENTRY(1, 10) \
  ENTRY(1, 11) \
  ENTRY(1, 12) \
  ENTRY(1, 13) \
  ENTRY(1, 14) \
  ENTRY(1, 15) \
  ENTRY(2, 1) \
  ENTRY(2, 2) \
  ENTRY(2, 3) \
  ENTRY(2, 4) \
  ENTRY(2, 11) \
  ENTRY(2, 14) \
  ENTRY(2, 29) \
  ENTRY(2, 36) \
  ENTRY(2, 38) \
  ENTRY(2, 39) \
  ENTRY(2, 40) \
  ENTRY(2, 45) \
  ENTRY(2, 46) \
  ENTRY(2, 47) \
  ENTRY(2, 48) \
  ENTRY(2, 49) \
  ENTRY(2, 50) \
  ENTRY(2, 51) \
  ENTRY(2, 52) \
  ENTRY(2, 53) \
  ENTRY(2, 54) \
  ENTRY(2, 55) \
  ENTRY(2, 56) \
  ENTRY(2, 57) \
  ENTRY(2, 58) \
  ENTRY(2, 59) \
  ENTRY(2, 60) \
  ENTRY(2, 65) \
  ENTRY(2, 66) \
  ENTRY(2, 68) \
  ENTRY(3, 8) \
  ENTRY(3, 9) \
  ENTRY(3, 16) \
  ENTRY(3, 17) \
  ENTRY(4, 18) \
  ENTRY(4, 19) \
  ENTRY(4, 33) \
  ENTRY(4, 34) \
  ENTRY(4, 35) \
  ENTRY(4, 36) \
  ENTRY(4, 38) \
  ENTRY(4, 39) \
  ENTRY(4, 41) \
  ENTRY(4, 42) \
  ENTRY(4, 44) \
  ENTRY(4, 45) \
  ENTRY(4, 52) \
  ENTRY(4, 53) \
  ENTRY(4, 54) \
  ENTRY(4, 55) \
  ENTRY(4, 56) \
  ENTRY(4, 57) \
  ENTRY(4, 58) \
  ENTRY(4, 59) \
  ENTRY(4, 72) \
  ENTRY(4, 75) \
  ENTRY(5, 9) \
  ENTRY(5, 11) \
  ENTRY(6, 1) \
  ENTRY(6, 2) \
  ENTRY(6, 3) \
  ENTRY(6, 4) \
  ENTRY(6, 5) \
  ENTRY(6, 6) \
  ENTRY(6, 7) \
  ENTRY(6, 8) \
  ENTRY(6, 9) \
  ENTRY(6, 10) \
  ENTRY(6, 11) \
  ENTRY(6, 12) \
  ENTRY(6, 14) \
  ENTRY(6, 15) \
  ENTRY(6, 16) \
  ENTRY(6, 18) \
  ENTRY(6, 19) \
  ENTRY(6, 20) \
  ENTRY(6, 21) \
  ENTRY(6, 22) \
  ENTRY(6, 24) \
  ENTRY(6, 25) \
  ENTRY(6, 26) \
  ENTRY(6, 27) \
  ENTRY(6, 28) \
  ENTRY(6, 29) \
  ENTRY(6, 30) \
  ENTRY(6, 31) \
  ENTRY(6, 32) \
  ENTRY(6, 33) \
  ENTRY(6, 34) \
  ENTRY(6, 35) \
  ENTRY(6, 37) \
  ENTRY(6, 38) \
  ENTRY(6, 39) \
  ENTRY(6, 41) \
  ENTRY(6, 42) \
  ENTRY(6, 43) \
  ENTRY(6, 44) \
  ENTRY(7, 1) \
  ENTRY(7, 2) \
  ENTRY(7, 3) \
  ENTRY(7, 4) \
  ENTRY(7, 6) \
  ENTRY(7, 7) \
  ENTRY(7, 8) \
  ENTRY(7, 9) \
  ENTRY(7, 10) \
  ENTRY(7, 11) \
  ENTRY(7, 12) \
  ENTRY(7, 13) \
  ENTRY(7, 15) \
  ENTRY(7, 16) \
  ENTRY(7, 17) \
  ENTRY(7, 18) \
  ENTRY(7, 19) \
  ENTRY(8, 6) \
  ENTRY(8, 9) \
  ENTRY(8, 10) \
  ENTRY(8, 12) \
  ENTRY(8, 13) \
  ENTRY(8, 14) \
  ENTRY(8, 15) \
  ENTRY(8, 16) \
  ENTRY(8, 19) \
  ENTRY(8, 20) \
  ENTRY(8, 21) \
  ENTRY(8, 22) \
  ENTRY(9, 2) \
  ENTRY(9, 7) \
  ENTRY(9, 8) \
  ENTRY(9, 13) \
  ENTRY(9, 14) \
  ENTRY(9, 16) \
  ENTRY(9, 17) \
  ENTRY(9, 24) \
  ENTRY(9, 25) \
  ENTRY(9, 26) \
  ENTRY(9, 28) \
  ENTRY(9, 34) \
  ENTRY(9, 35) \
  ENTRY(9, 36) \
  ENTRY(9, 38) \
  ENTRY(9, 40) \
  ENTRY(9, 41) \
  ENTRY(9, 42) \
  ENTRY(9, 43) \
  ENTRY(9, 44) \
  ENTRY(9, 45) \
  ENTRY(9, 47) \
  ENTRY(9, 50) \
  ENTRY(10, 11) \
  ENTRY(10, 13) \
  ENTRY(A, 8)
// clang-format on

namespace etendue::figures {

#define ETENDUE_DECLARE_FIGURE(CHAPTER, NUMBER) Figure figure_##CHAPTER##_##NUMBER();
ETENDUE_FIGURES(ETENDUE_DECLARE_FIGURE)
#undef ETENDUE_DECLARE_FIGURE

namespace {

Figure numbered(Figure figure, const char* number) {
  figure.number = number;
  return figure;
}

}  // namespace

const std::vector<Figure>& figures() {
#define ETENDUE_CALL_FIGURE(CHAPTER, NUMBER) numbered(figure_##CHAPTER##_##NUMBER(), #CHAPTER "." #NUMBER),
  static const std::vector<Figure> all{ETENDUE_FIGURES(ETENDUE_CALL_FIGURE)};
#undef ETENDUE_CALL_FIGURE
  return all;
}

const Figure* find_figure(std::string_view number) {
  for (const Figure& figure : figures())
    if (figure.number == number) return &figure;
  return nullptr;
}

}  // namespace etendue::figures
