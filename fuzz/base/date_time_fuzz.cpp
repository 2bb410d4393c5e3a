#include "../fuzzing.hpp"
#include "base/value.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wold;
  DateTime time;
  if (fuzzing::accepts([&] { time = parse_date_time(fuzzing::text_of(data, size)); })) {
    const DateTime again = parse_date_time(to_text(time));
    fuzzing::require(again.year == time.year && again.minute == time.minute &&
                     again.offset_minutes == time.offset_minutes);
  }
  return 0;
}
