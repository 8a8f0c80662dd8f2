#include "viewer/widgets/format.h"

namespace etendue::viewer {

std::string time_text(double seconds) {
  const auto whole = static_cast<long long>(seconds);
  if (whole >= 3600) return text_of("%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60, whole % 60);
  return text_of("%lld:%02lld", whole / 60, whole % 60);
}

std::string memory_text(size_t bytes) {
  const double mega = static_cast<double>(bytes) / (1 << 20);
  return mega < 1      ? text_of("%.0f kB", mega * 1024)
         : mega < 1024 ? text_of("%.0f MB", mega)
                       : text_of("%.1f GB", mega / 1024);
}

}  // namespace etendue::viewer
