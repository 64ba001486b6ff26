#include "dashpot/record/readers/tdms.h"

#include <limits>

#include "dashpot/base/random.h"
#include "dashpot/dataset.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/reader.h"
#include "example_tdms.h"
#include "support.h"

using namespace dashpot;

namespace {

std::vector<RawTable> read_tdms_bytes(const std::string& bytes) {
  const TemporaryFolder folder;
  return read_tables(folder.write("run.tdms", bytes));
}

void check_example(const RawTable& table, std::size_t rows) {
  REQUIRE(table.columns.size() == 2);
  REQUIRE(table.rows() == rows);
  CHECK(table.columns[0].name == "displacement");
  CHECK(table.columns[0].unit == "mm");
  CHECK(table.sample_time == 0.01);
  for (std::size_t k = 0; k < rows; ++k) {
    CHECK(table.columns[0].values[k] == 1.5 * double(k % 7));
    CHECK(table.columns[1].values[k] == 2 + 0.1 * (100 * double(k % 5) - 200));
  }
}

}  // namespace

TEST_CASE("TDMS: interleaved or not, both orders of bytes, several chunks hold the same") {
  for (const bool interleaved : {false, true})
    for (const bool big_endian : {false, true}) {
      CAPTURE(interleaved);
      CAPTURE(big_endian);
      const auto tables = read_tdms_bytes(example_tdms(interleaved, big_endian));
      REQUIRE(tables.size() == 1);
      check_example(tables.front(), 40);
    }
}

TEST_CASE("TDMS: the unit of X counts, starts of their own are told, and a step that nobody set") {
  // A segment that sets properties of both channels, of the second one's own too.
  const auto with = [](const TdmsTexts& texts, const TdmsNumbers& numbers, double start) {
    TdmsBytes set;
    set.add<std::uint32_t>(2);
    for (const char* channel : {"/'run'/'displacement'", "/'run'/'force'"}) {
      set.text(channel).add<std::uint32_t>(0xFFFFFFFF);
      TdmsNumbers all = numbers;
      all.emplace_back("wf_start_time", contains(channel, "force") ? start : 0);
      add_tdms_properties(set, texts, all);
    }
    return example_tdms(false, false) + tdms_segment(kTdmsMetadata, set.bytes, "");
  };
  const RawTable table =
      read_tdms_bytes(with({{"wf_xunit_string", "ms"}}, {{"wf_increment", 2}}, 1)).front();
  CHECK(table.sample_time == doctest::Approx(2e-3));
  CHECK(contains(table.notes.at(0), "begin at different times (wf_start_time)"));
  const RawTable spectrum =
      read_tdms_bytes(with({{"wf_xunit_string", "Hz"}}, {{"wf_increment", 2}}, 0)).front();
  CHECK_FALSE(spectrum.sample_time);
  CHECK(contains(spectrum.notes.at(0), "is in Hz, and not taken as time base"));

  const TemporaryFolder folder;
  const auto path = folder.write("run.tdms", with({}, {{"wf_increment", 1}}, 0));
  CHECK(contains(message_of([&] { load_dataset({path}); }), "the file states steps of 1"));
}

TEST_CASE(
    "TDMS: a channel on a time base of its own is passed over; a step that nobody set is none") {
  const auto with_force_at = [](double increment) {
    TdmsBytes set;
    set.add<std::uint32_t>(1);
    set.text("/'run'/'force'").add<std::uint32_t>(0xFFFFFFFF);
    add_tdms_properties(set, {}, {{"wf_increment", increment}});
    return read_tdms_bytes(example_tdms(false, false) + tdms_segment(kTdmsMetadata, set.bytes, ""))
        .front();
  };
  const RawTable apart = with_force_at(0.02);
  REQUIRE(apart.columns.size() == 1);
  CHECK(apart.sample_time == 0.01);
  CHECK(apart.notes.at(0) ==
        "channel 'force' passed over: its wf_increment is 0.02 s, that of the recording 0.01 s");
  check_example(with_force_at(1), 40);
}

TEST_CASE("TDMS: later segments say what changed, or nothing at all") {
  // The same list again without metadata, then one channel left out and a property set.
  TdmsBytes less;
  less.add<std::uint32_t>(2);
  less.text("/'run'/'force'").add<std::uint32_t>(0);
  add_tdms_properties(less, {{"unit_string", "kN"}}, {});
  less.text("/'run'/'displacement'").add<std::uint32_t>(0xFFFFFFFF);
  add_tdms_properties(less, {}, {});
  TdmsBytes raw, last;
  for (int k = 0; k < 20; ++k) raw.add(double(k));
  for (int k = 0; k < 20; ++k) raw.add<std::int16_t>(10), last.add<std::int16_t>(20);

  const std::string bytes = example_tdms(false, false) + tdms_segment(kTdmsRawData, "", raw.bytes);
  const auto same = read_tdms_bytes(bytes);
  CHECK(same.front().rows() == 60);
  CHECK(same.front().columns[0].values[59] == 19);
  CHECK(same.front().columns[1].values[59] == 3);

  const auto changed =
      read_tdms_bytes(bytes + tdms_segment(kTdmsMetadata | kTdmsRawData, less.bytes, last.bytes));
  REQUIRE(changed.front().columns.size() == 1);
  CHECK(changed.front().columns[0].unit == "kN");
  CHECK(changed.front().columns[0].values[79] == 4);
  REQUIRE(changed.front().notes.size() == 1);
  CHECK(changed.front().notes[0] ==
        "channel 'displacement' passed over: 60 values, the recording has 80");
}

TEST_CASE("TDMS: DAQmx rows with a scale of two steps") {
  const RawTable table = read_tdms_bytes(example_tdms_daqmx()).front();
  REQUIRE(table.columns.size() == 2);
  CHECK(table.columns[0].values == std::vector<double>{1, 0.75, 1, 1.75, 3, 4.75});
  CHECK(table.columns[1].values == std::vector<double>{0, 70000, 140000, 210000, 280000, 350000});
  CHECK(table.sample_time == 0.05);
}

TEST_CASE("TDMS: stamps count in seconds; texts and sensors' scales are passed over by name") {
  TdmsBytes metadata, raw;
  metadata.add<std::uint32_t>(4);
  add_tdms_channel(metadata, "/'it''s'/'time'", 0x44, 2);
  add_tdms_channel(metadata, "/'it''s'/'F'", 9, 2);
  add_tdms_channel(metadata, "/'it''s'/'hot'", 9, 2, {{"NI_Scale[0]_Scale_Type", "RTD"}});
  metadata.text("/'it''s'/'words'").add<std::uint32_t>(28).add<std::uint32_t>(0x20);
  metadata.add<std::uint32_t>(1).add<std::uint64_t>(2).add<std::uint64_t>(10);
  add_tdms_properties(metadata, {}, {});
  raw.add<std::uint64_t>(1ull << 62).add<std::int64_t>(3'800'000'000);
  raw.add<std::uint64_t>(3ull << 62).add<std::int64_t>(3'800'000'001);
  raw.add(1.5f).add(2.5f).add(1.0f).add(2.0f);
  raw.add<std::uint32_t>(1).add<std::uint32_t>(2).bytes += "ab";
  const RawTable table = read_tdms_bytes(tdms_segment(kTdmsMetadata | kTdmsNewList | kTdmsRawData,
                                                      metadata.bytes, raw.bytes))
                             .front();
  REQUIRE(table.columns.size() == 2);
  CHECK(table.columns[0].values == std::vector<double>{0.25, 1.75});
  CHECK(table.columns[0].unit == "s");
  CHECK(table.columns[1].values == std::vector<double>{1.5, 2.5});
  REQUIRE(table.notes.size() == 2);
  CHECK(table.notes[0] == "channel 'words' passed over: it holds texts");
  CHECK(table.notes[1] == "channel 'hot' passed over: its scale is of the kind 'RTD'");
}

TEST_CASE("TDMS: stamps as far apart as their numbers allow are seconds like others") {
  TdmsBytes metadata, raw;
  metadata.add<std::uint32_t>(1);
  add_tdms_channel(metadata, "/'run'/'time'", 0x44, 2);
  for (const std::int64_t whole :
       {std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min()})
    raw.add<std::uint64_t>(0).add(whole);
  const RawTable table = read_tdms_bytes(tdms_segment(kTdmsMetadata | kTdmsNewList | kTdmsRawData,
                                                      metadata.bytes, raw.bytes))
                             .front();
  CHECK(table.columns.front().values == std::vector<double>{0, -0x1p64});
}

TEST_CASE("TDMS: a writer that never closed its file loses what is not whole, with a note") {
  for (const bool interleaved : {false, true}) {
    const auto tables = read_tdms_bytes(example_tdms(interleaved, false, 2, 20, false, 5));
    CAPTURE(interleaved);
    // Five bytes are two values and a half of 16 bits, or a part of the last row.
    const std::size_t rows = interleaved ? 39 : 37;
    check_example(tables.front(), rows);
    REQUIRE(tables.front().notes.size() == 1);
    CHECK(tables.front().notes[0].find("its writer never closed it") != std::string::npos);
  }
}

TEST_CASE("TDMS: what is damaged is refused with the place") {
  const std::string whole = example_tdms(false, false);
  for (std::size_t size = 4; size + 1 < whole.size(); size += 37)
    CHECK_THROWS_AS(read_tdms_bytes(whole.substr(0, size)), Error);

  TdmsBytes many;
  many.add<std::uint32_t>(1);
  add_tdms_channel(many, "/'a'/'F'", 10, 1ull << 40);
  CHECK_THROWS_WITH_AS(
      read_tdms_bytes(tdms_segment(kTdmsMetadata | kTdmsRawData, many.bytes, "12345678")),
      doctest::Contains("more values than bytes"), Error);
  TdmsBytes endless;
  endless.add<std::uint32_t>(0xFFFFFFFF);
  CHECK_THROWS_WITH_AS(read_tdms_bytes(tdms_segment(kTdmsMetadata, endless.bytes, "")),
                       doctest::Contains("metadata that end too early at byte 32"), Error);
  CHECK_THROWS_WITH_AS(read_tdms_bytes(tdms_segment(kTdmsRawData, "", "12345678")),
                       doctest::Contains("raw data of no channel"), Error);
}

TEST_CASE("TDMS: flipped bytes are read or refused, and nothing else") {
  Random random(13);
  for (const std::string& whole :
       {example_tdms(false, false), example_tdms(true, true), example_tdms_daqmx()})
    for (int k = 0; k < 300; ++k) {
      std::string bytes = whole;
      for (int flips = 0; flips < 3; ++flips)
        bytes[static_cast<std::size_t>(random.uniform() * double(bytes.size()))] ^=
            static_cast<char>(1 << int(8 * random.uniform()));
      try {
        read_tdms_bytes(bytes);
      } catch (const Error&) {
      }
    }
}
