#include "dashpot/record.h"

#include "support.h"

using namespace dashpot;

TEST_CASE("keep does in place what slice does in a copy") {
  Record record;
  record.time = {0, 1, 2, 3, 4};
  record.channels.push_back({"force", "N", {10, 11, 12, 13, 14}, ""});
  record.warm_up = 2;
  for (const auto& [first, last] :
       {std::pair<std::size_t, std::size_t>{1, 4}, {0, 5}, {3, 9}, {4, 2}, {9, 9}}) {
    const Record slice = record.slice(first, last);
    Record kept = record;
    kept.keep(first, last);
    CHECK(kept.time == slice.time);
    CHECK(kept.channels[0].samples == slice.channels[0].samples);
    CHECK(kept.warm_up == slice.warm_up);
  }
}
