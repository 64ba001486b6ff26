#include "dashpot/record/readers/mdf4.h"

#include <cmath>

#include "dashpot/base/random.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/reader.h"
#include "example_mdf4.h"
#include "support.h"

using namespace dashpot;

namespace {

std::vector<RawTable> read_mdf4_bytes(const std::string& bytes) {
  const TemporaryFolder folder;
  return read_tables(folder.write("run.mf4", bytes));
}

/// One group of doubles in records of these channels.
RawTable read_group(ExampleMdf4& file, const std::vector<ExampleMdf4::Channel>& channels,
                    const std::string& records, std::uint32_t size, std::uint32_t invalid = 0) {
  const std::uint64_t data = file.data(records);
  const std::uint64_t group =
      file.group(channels, records.size() / (size + invalid), size, invalid);
  return read_mdf4_bytes(file.finish(file.data_group(group, data))).front();
}

}  // namespace

TEST_CASE("MDF 4: plain, deflated, transposed and listed data hold the same") {
  for (const int way : {0, 1, 2, 3}) {
    CAPTURE(way);
    const auto tables = read_mdf4_bytes(example_mdf4(way));
    REQUIRE(tables.size() == 1);
    const RawTable& table = tables.front();
    REQUIRE(table.rows() == 40);
    REQUIRE(table.columns.size() == 3);
    CHECK(table.columns[0].name == "t");
    CHECK(table.columns[1].unit == "mm");
    for (std::size_t k = 0; k < 40; ++k) {
      CHECK(table.columns[0].values[k] == 0.01 * double(k));
      CHECK(table.columns[1].values[k] == 1.5 * double(k % 7));
      CHECK(table.columns[2].values[k] == 0.1 * (100 * double(k % 5) - 200));
    }
  }
}

TEST_CASE("MDF 4: integers of any width and order, single precision, a virtual time") {
  ExampleMdf4 file;
  const std::uint64_t step = file.conversion(1, {1, 0.5});
  // Two samples: a big-endian 16 bit integer, 12 bits from bit 3 on, a float, an unsigned 64 bit.
  std::string records;
  records += std::string("\xFF\x38", 2);  // -200
  put<std::uint16_t>(records, 0x9A5 << 3);
  put(records, 2.5f), put<std::uint64_t>(records, 1ull << 60);
  records += std::string("\x01\x00", 2);  // 256
  put<std::uint16_t>(records, 0x7FF << 3);
  put(records, -0.1f), put<std::uint64_t>(records, 3);

  const RawTable table =
      read_group(file,
                 {{.name = "t", .kind = 3, .sync = 1, .bits = 0, .conversion = step},
                  {.name = "a", .type = 3, .byte = 0, .bits = 16},
                  {.name = "b", .type = 2, .first_bit = 3, .byte = 2, .bits = 12},
                  {.name = "c", .type = 4, .byte = 4, .bits = 32},
                  {.name = "d", .type = 0, .byte = 8, .bits = 64},
                  {.name = "state", .type = 0, .byte = 8, .bits = 1},
                  {.name = "words", .type = 6, .byte = 8, .bits = 64}},
                 records, 16);
  REQUIRE(table.columns.size() == 5);
  CHECK(table.columns[0].unit == "s");
  CHECK(table.columns[0].values == std::vector<double>{1, 1.5});
  CHECK(table.columns[1].values == std::vector<double>{-200, 256});
  CHECK(table.columns[2].values == std::vector<double>{0x9A5 - 4096, 0x7FF});
  CHECK(table.columns[3].values == std::vector<double>{2.5, double(-0.1f)});
  CHECK(table.columns[4].values == std::vector<double>{std::pow(2.0, 60), 3});
  REQUIRE(table.notes.size() == 2);
  CHECK(table.notes[0] == "channel 'state' passed over: it is a state of 1 bits");
  CHECK(table.notes[1].find("'words' passed over: it holds texts") != std::string::npos);
}

TEST_CASE("MDF 4: conversions by the standard's numbers; bits that say invalid") {
  ExampleMdf4 file;
  const std::uint64_t rational = file.conversion(2, {0, 2, 1, 0, 0, 4});
  const std::uint64_t line = file.conversion(4, {0, 10, 2, 30, 4, 40});
  const std::uint64_t nearest = file.conversion(5, {0, 10, 2, 30, 4, 40});
  const std::uint64_t ranges = file.conversion(6, {0, 1, 7, 1.5, 9, 8, -1});
  std::string records;
  for (const double x : {-1.0, 1.2, 3.0, 99.0}) put(records, x), records += x == 3 ? '\x02' : '\0';
  const RawTable table = read_group(file,
                                    {{.name = "a", .conversion = rational},
                                     {.name = "b", .conversion = line},
                                     {.name = "c", .conversion = nearest},
                                     {.name = "d", .conversion = ranges},
                                     {.name = "e", .flags = 2, .invalid_bit = 1}},
                                    records, 8, 1);
  REQUIRE(table.columns.size() == 5);
  CHECK(table.columns[0].values == std::vector<double>{-0.25, 0.85, 1.75, 49.75});
  CHECK(table.columns[1].values == std::vector<double>{10, 22, 35, 40});
  CHECK(table.columns[2].values == std::vector<double>{10, 30, 30, 40});
  CHECK(table.columns[3].values == std::vector<double>{-1, -1, 8, -1});
  REQUIRE(table.columns[4].bad);
  CHECK(table.columns[4].bad->row == 2);
  CHECK(table.columns[4].bad->text == "marked invalid");
  CHECK(std::isnan(table.columns[4].values[2]));
}

TEST_CASE("MDF 4: halves; texts for some values leave the others numbers") {
  ExampleMdf4 file;
  const std::uint64_t text = file.text("sensor fault"), tenth = file.conversion(1, {0, 0.1});
  const std::uint64_t of_value = file.conversion(7, {255}, {text, tenth});
  const std::uint64_t of_range = file.conversion(8, {250, 260}, {text, tenth});
  const std::uint64_t all_texts = file.conversion(7, {255}, {text, text});
  std::string records;
  for (const auto& [half, value] :
       {std::pair<std::uint16_t, double>{0xC100, 20}, {0x3555, 255}, {0x0001, 251}})
    put(records, half), put(records, value);
  const RawTable table = read_group(file,
                                    {{.name = "h", .bits = 16},
                                     {.name = "v", .byte = 2, .conversion = of_value},
                                     {.name = "r", .byte = 2, .conversion = of_range},
                                     {.name = "w", .byte = 2, .conversion = all_texts}},
                                    records, 10);
  REQUIRE(table.columns.size() == 3);
  CHECK(table.columns[0].values == std::vector<double>{-2.5, 1365.0 / 4096, std::ldexp(1, -24)});
  CHECK(table.columns[1].values[0] == 2);
  CHECK(std::isnan(table.columns[1].values[1]));
  CHECK(table.columns[1].values[2] == 251 * 0.1);
  CHECK(std::isnan(table.columns[2].values[2]));
  REQUIRE(table.notes.size() == 3);
  CHECK(table.notes[0] == "channel 'v': values that its conversion gives as texts are no numbers");
  CHECK(table.notes[2] == "channel 'w' passed over: its conversion gives texts");
}

TEST_CASE("MDF 4: channels in groups of their own with the same times are one recording") {
  const auto read = [](double shift) {
    ExampleMdf4 file;
    std::string forces, strokes;
    for (int k = 0; k < 40; ++k) {
      put(forces, 0.01 * k), put(forces, 100.0 * (k % 5));
      put(strokes, 0.01 * k + shift), put(strokes, 1.5 * (k % 7));
    }
    const auto group = [&](const char* name, const char* unit, const std::string& records,
                           std::uint64_t next) {
      const std::uint64_t data = file.data(records);
      const std::uint64_t channels = file.group({{.name = "t", .unit = "s", .kind = 2, .sync = 1},
                                                 {.name = name, .unit = unit, .byte = 8}},
                                                40, 16);
      return file.data_group(channels, data, 0, next);
    };
    const std::uint64_t second = group("displacement", "mm", strokes, 0);
    return read_mdf4_bytes(file.finish(group("force", "N", forces, second)));
  };
  const auto tables = read(0);
  REQUIRE(tables.size() == 1);
  REQUIRE(tables.front().columns.size() == 3);
  CHECK(tables.front().columns[2].name == "displacement");
  CHECK(tables.front().columns[2].values[6] == 9);
  CHECK(tables.front().notes.at(0) ==
        "'displacement' is of a group of its own with the same times");

  const auto apart = read(0.001);
  REQUIRE(apart.size() == 1);
  CHECK(apart.front().columns.size() == 2);
  CHECK(apart.front().notes.at(0).find("passed over") != std::string::npos);
}

TEST_CASE("MDF 4: records of several groups in one stream; the group with the force is read") {
  ExampleMdf4 file;
  std::string stream;
  for (int k = 0; k < 40; ++k) {
    stream += '\x01' + example_mdf4_record(k);
    if (k % 4 == 0) put<std::uint8_t>(stream, 2), put(stream, 0.01 * k), put(stream, 20.0);
  }
  const std::uint64_t data = file.data(stream);
  const std::uint64_t slow = file.group({{.name = "t", .unit = "s", .kind = 2, .sync = 1},
                                         {.name = "temperature", .unit = "degC", .byte = 8}},
                                        10, 16, 0, 2);
  const std::uint64_t fast = file.group(example_mdf4_channels(file), 40, 18, 0, 1, slow);
  const auto tables = read_mdf4_bytes(file.finish(file.data_group(fast, data, 1)));
  REQUIRE(tables.size() == 1);
  CHECK(tables.front().rows() == 40);
  CHECK(tables.front().columns[2].values[3] == 10);
  REQUIRE(tables.front().notes.size() == 1);
  CHECK(tables.front().notes[0].find("'t', 'temperature'") != std::string::npos);
}

TEST_CASE("MDF 4: what is damaged is refused with the place") {
  // Cut off anywhere.
  const std::string whole = example_mdf4(3);
  for (std::size_t size = 8; size + 1 < whole.size(); size += 61)
    CHECK_THROWS_AS(read_mdf4_bytes(whole.substr(0, size)), Error);

  // More samples stated than there are, a circle of blocks, a channel beyond its record.
  ExampleMdf4 more;
  const std::uint64_t data = more.data(example_mdf4_record(0) + example_mdf4_record(1));
  const std::uint64_t group = more.group(example_mdf4_channels(more), 1ull << 60, 18);
  CHECK_THROWS_WITH_AS(read_mdf4_bytes(more.finish(more.data_group(group, data))),
                       doctest::Contains("1152921504606846976 samples and holds 2"), Error);
  ExampleMdf4 circle;
  const std::uint64_t lonely = circle.group({}, 0, 8);
  const std::uint64_t at = circle.data_group(lonely, 0);
  std::string bytes = circle.finish(at);
  std::string self;
  put(self, at);
  bytes.replace(at + 24, 8, self);
  CHECK_THROWS_WITH_AS(read_mdf4_bytes(bytes), doctest::Contains("in a circle"), Error);
  ExampleMdf4 beyond;
  CHECK_THROWS_WITH_AS(read_group(beyond, {{.name = "F", .byte = 9}}, std::string(16, 'a'), 16),
                       doctest::Contains("'F' that lies beyond its record"), Error);

  // Packed data that state more than so few bytes can hold.
  ExampleMdf4 lying;
  const std::uint64_t packed = lying.packed(example_mdf4_record(0));
  const std::uint64_t records = lying.group(example_mdf4_channels(lying), 1, 18);
  bytes = lying.finish(lying.data_group(records, packed));
  std::string stated;
  put<std::uint64_t>(stated, 60 << 20);
  bytes.replace(packed + 24 + 8, 8, stated);
  CHECK_THROWS_WITH_AS(read_mdf4_bytes(bytes), doctest::Contains("cannot be, in the block DZ"),
                       Error);

  // What is not finished, and what is older.
  std::string other = whole;
  other.replace(0, 8, "UnFinMF ");
  CHECK_THROWS_WITH_AS(read_mdf4_bytes(other), doctest::Contains("was not finished"), Error);
  other = whole;
  other[28] = 74, other[29] = 1;
  CHECK_THROWS_WITH_AS(read_mdf4_bytes(other), doctest::Contains("is MDF of version 3.3"), Error);
}

TEST_CASE("MDF 4: storage by column is refused with what to save instead") {
  // Listed, plain and packed.
  for (const int way : {0, 1, 2}) {
    CAPTURE(way);
    ExampleMdf4 file;
    const std::string records = example_mdf4_record(0) + example_mdf4_record(1);
    std::uint64_t data = way == 2 ? file.packed(records) : file.block("DV", {}, records);
    if (way == 1) data = file.block("LD", {0, data}, std::string(16, '\0'));
    const std::uint64_t group = file.group(example_mdf4_channels(file), 2, 18);
    std::string bytes = file.finish(file.data_group(group, data));
    if (way == 2) bytes.replace(data + 24, 2, "DV");
    CHECK_THROWS_WITH_AS(read_mdf4_bytes(bytes), doctest::Contains("save it as MDF 4.1"), Error);
  }
}

TEST_CASE("MDF 4: values of different lengths are passed over with a note") {
  ExampleMdf4 file;
  std::vector<ExampleMdf4::Channel> channels = example_mdf4_channels(file);
  channels.push_back({.name = "remark", .kind = 1, .type = 7, .byte = 10, .bits = 64});
  std::string records;
  for (int k = 0; k < 3; ++k) records += example_mdf4_record(k);
  const RawTable table = read_group(file, channels, records, 18);
  CHECK(table.columns.size() == 3);
  REQUIRE(table.notes.size() == 1);
  CHECK(table.notes[0] == "channel 'remark' passed over: its values have different lengths");
}

TEST_CASE("MDF 4: a bomb of packed blocks listed again and again is refused" *
          doctest::test_suite("long")) {
  ExampleMdf4 file;
  const std::uint64_t block = file.packed(std::string(std::size_t{8} << 20, '\0'));
  const std::uint64_t data = file.list(std::vector<std::uint64_t>(200, block));
  const std::uint64_t group = file.group(example_mdf4_channels(file), 1000, 18);
  CHECK_THROWS_WITH_AS(read_mdf4_bytes(file.finish(file.data_group(group, data))),
                       doctest::Contains("far more data"), Error);

  // Channels that lie over each other, each of all bytes.
  ExampleMdf4 over;
  const std::uint64_t bytes = over.packed(std::string(std::size_t{8} << 20, '\0'));
  std::vector<ExampleMdf4::Channel> channels;
  for (int k = 0; k < 60; ++k)
    channels.push_back({.name = "c" + std::to_string(k), .type = 0, .byte = 0, .bits = 8});
  const std::uint64_t all = over.group(channels, 8 << 20, 1);
  CHECK_THROWS_WITH_AS(read_mdf4_bytes(over.finish(over.data_group(all, bytes))),
                       doctest::Contains("far more values"), Error);
}

// It would take minutes if each of the columns, which there are not, took its time.
TEST_CASE("MDF 4: rows of four billion bytes, of which none is whole, stand as they are") {
  ExampleMdf4 file;
  const std::uint64_t block = file.packed(example_mdf4_record(0));
  const std::uint64_t data = file.list(std::vector<std::uint64_t>(100, block));
  const std::uint64_t group = file.group(example_mdf4_channels(file), 100, 18);
  std::string bytes = file.finish(file.data_group(group, data));
  bytes.replace(block + 24 + 2, 6, std::string("\1\0\xff\xff\xff\xff", 6));
  CHECK(read_mdf4_bytes(bytes).front().rows() == 100);
}

TEST_CASE("MDF 4: flipped bytes are read or refused, and nothing else") {
  Random random(11);
  for (const int way : {0, 3})
    for (int k = 0; k < 400; ++k) {
      std::string bytes = example_mdf4(way);
      for (int flips = 0; flips < 3; ++flips)
        bytes[static_cast<std::size_t>(random.uniform() * double(bytes.size()))] ^=
            static_cast<char>(1 << int(8 * random.uniform()));
      try {
        read_mdf4_bytes(bytes);
      } catch (const Error&) {
      }
    }
}
