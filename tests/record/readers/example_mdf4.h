#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>
#include <zlib.h>

// A small writer of MDF 4 files, for tests and as seeds of fuzzing.

/// Appends a number's bytes, the least significant first.
template <class Number>
void put(std::string& bytes, Number value) {
  char raw[sizeof(Number)];
  std::memcpy(raw, &value, sizeof(Number));
  bytes.append(raw, sizeof(Number));
}

/// Blocks one after the other; links to blocks that have been written already.
class ExampleMdf4 {
 public:
  ExampleMdf4() {
    bytes_ = "MDF     4.10    example ";
    bytes_.resize(28, '\0');
    put<std::uint16_t>(bytes_, 410);
    bytes_.resize(64 + 104, '\0');  // the head, filled in at the end
  }

  std::uint64_t block(const char* name, const std::vector<std::uint64_t>& links,
                      const std::string& data) {
    bytes_.resize((bytes_.size() + 7) / 8 * 8, '\0');
    const std::uint64_t at = bytes_.size();
    bytes_ += block_bytes(name, links, data);
    return at;
  }
  std::uint64_t text(const std::string& text) { return block("TX", {}, text + '\0'); }

  /// A conversion with its numbers and texts, by the kind's number of the standard.
  std::uint64_t conversion(int kind, const std::vector<double>& numbers,
                           const std::vector<std::uint64_t>& texts = {}) {
    std::string data(1, static_cast<char>(kind));
    data += std::string(3, '\0');
    put(data, static_cast<std::uint16_t>(texts.size()));
    put(data, static_cast<std::uint16_t>(numbers.size()));
    put(data, 0.0), put(data, 0.0);
    for (const double number : numbers) put(data, number);
    std::vector<std::uint64_t> links{0, 0, 0, 0};
    links.insert(links.end(), texts.begin(), texts.end());
    return block("CC", links, data);
  }

  struct Channel {
    std::string name, unit;
    int kind = 0, sync = 0, type = 4;  ///< 0 fixed, 2 master, 3 virtual master; 4 is a double
    int first_bit = 0;
    std::uint32_t byte = 0, bits = 64, flags = 0, invalid_bit = 0;
    std::uint64_t conversion = 0;
  };
  /// A group of channels, before `next`.
  std::uint64_t group(const std::vector<Channel>& channels, std::uint64_t records,
                      std::uint32_t data_bytes, std::uint32_t invalid_bytes = 0,
                      std::uint64_t id = 0, std::uint64_t next = 0) {
    std::uint64_t first = 0;
    for (std::size_t k = channels.size(); k-- > 0;) first = channel(channels[k], first);
    std::string data;
    put(data, id), put(data, records);
    put<std::uint64_t>(data, 0);
    put(data, data_bytes), put(data, invalid_bytes);
    return block("CG", {next, first, 0, 0, 0, 0}, data);
  }

  std::uint64_t data(const std::string& records) { return block("DT", {}, records); }
  /// The same, packed; with a width above 1 column by column.
  std::uint64_t packed(const std::string& records, std::size_t width = 1) {
    std::string plain = records;
    const std::size_t rows = width > 1 ? records.size() / width : 0;
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t c = 0; c < width; ++c) plain[c * rows + r] = records[r * width + c];
    uLongf size = compressBound(plain.size());
    std::string deflated(size, '\0');
    compress(reinterpret_cast<Bytef*>(deflated.data()), &size,
             reinterpret_cast<const Bytef*>(plain.data()), plain.size());
    deflated.resize(size);

    std::string data = "DT";
    data += static_cast<char>(width > 1), data += '\0';
    put<std::uint32_t>(data, static_cast<std::uint32_t>(width));
    put<std::uint64_t>(data, plain.size()), put<std::uint64_t>(data, size);
    return block("DZ", {}, data + deflated);
  }
  /// A list of blocks of data, before another list.
  std::uint64_t list(std::vector<std::uint64_t> blocks, std::uint64_t next = 0) {
    std::string data(4, '\0');
    put<std::uint32_t>(data, static_cast<std::uint32_t>(blocks.size()));
    blocks.insert(blocks.begin(), next);
    return block("DL", blocks, data + std::string(8 * blocks.size(), '\0'));
  }
  std::uint64_t data_group(std::uint64_t group, std::uint64_t data, char id_bytes = 0,
                           std::uint64_t next = 0) {
    return block("DG", {next, group, data, 0}, id_bytes + std::string(7, '\0'));
  }

  std::string finish(std::uint64_t data_group) {
    const std::string head = block_bytes("HD", {data_group, 0, 0, 0, 0, 0}, std::string(32, '\0'));
    return bytes_.replace(64, head.size(), head);
  }

 private:
  static std::string block_bytes(const char* name, const std::vector<std::uint64_t>& links,
                                 const std::string& data) {
    std::string bytes = std::string("##") + name + std::string(4, '\0');
    put<std::uint64_t>(bytes, 24 + 8 * links.size() + data.size());
    put<std::uint64_t>(bytes, links.size());
    for (const std::uint64_t link : links) put(bytes, link);
    return bytes + data;
  }

  std::uint64_t channel(const Channel& channel, std::uint64_t next) {
    const std::uint64_t name = text(channel.name);
    const std::uint64_t unit = channel.unit.empty() ? 0 : text(channel.unit);
    std::string data;
    for (const int value : {channel.kind, channel.sync, channel.type, channel.first_bit})
      data += static_cast<char>(value);
    put(data, channel.byte), put(data, channel.bits), put(data, channel.flags);
    put(data, channel.invalid_bit);
    data.resize(72, '\0');
    return block("CN", {next, 0, name, 0, channel.conversion, 0, unit, 0}, data);
  }

  std::string bytes_;
};

/// A record of time (s), displacement (mm, double) and force (0.1 N as 16 bits).
inline std::string example_mdf4_record(int k) {
  std::string record;
  put(record, 0.01 * k), put(record, 1.5 * (k % 7));
  put<std::int16_t>(record, static_cast<std::int16_t>(100 * (k % 5) - 200));
  return record;
}

inline std::vector<ExampleMdf4::Channel> example_mdf4_channels(ExampleMdf4& file) {
  const std::uint64_t tenth = file.conversion(1, {0, 0.1});
  return {{.name = "t", .unit = "s", .kind = 2, .sync = 1},
          {.name = "displacement", .unit = "mm", .byte = 8},
          {.name = "force", .unit = "N", .type = 2, .byte = 16, .bits = 16, .conversion = tenth}};
}

/// `way`: 0 plain, 1 deflated, 2 deflated by columns, 3 a list of both and of a plain block.
inline std::string example_mdf4(int way) {
  ExampleMdf4 file;
  std::string records[3];
  for (int k = 0; k < 40; ++k) records[k / 16] += example_mdf4_record(k);
  const std::string all = records[0] + records[1] + records[2];
  std::uint64_t data = 0;
  if (way == 0) data = file.data(all);
  if (way == 1) data = file.packed(all);
  if (way == 2) data = file.packed(all, 18);
  if (way == 3) {
    const std::uint64_t last = file.list({file.data(records[2])});
    data = file.list({file.packed(records[0]), file.packed(records[1], 18)}, last);
  }
  const std::uint64_t group = file.group(example_mdf4_channels(file), 40, 18);
  return file.finish(file.data_group(group, data));
}
