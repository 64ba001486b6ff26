#include "dashpot/record/readers/mdf4_channel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace dashpot {
namespace {

/// The stored bits as an integer, from up to 9 bytes.
std::uint64_t stored_bits(const Mdf4Channel& channel, const char* record) {
  const auto* from = reinterpret_cast<const unsigned char*>(record + channel.byte);
  unsigned __int128 all = 0;
  for (std::uint32_t k = 0; k < channel.bytes; ++k)
    all = (all << 8) | from[channel.big_endian ? k : channel.bytes - 1 - k];
  const auto bits = static_cast<std::uint64_t>(all >> channel.first_bit);
  return channel.bits == 64 ? bits : bits & ((std::uint64_t{1} << channel.bits) - 1);
}

/// A half: 1 bit of sign, 5 of the exponent, 10 of the fraction (IEEE 754 binary16).
double half_number(std::uint16_t bits) {
  const int exponent = (bits >> 10) & 31, fraction = bits & 1023;
  const double size = exponent == 31  ? fraction == 0 ? std::numeric_limits<double>::infinity()
                                                      : std::numeric_limits<double>::quiet_NaN()
                      : exponent == 0 ? std::ldexp(fraction, -24)
                                      : std::ldexp(1024 + fraction, exponent - 25);
  return bits >> 15 ? -size : size;
}

double stored_number(const Mdf4Channel& channel, const char* record) {
  using Type = Mdf4Channel::Type;
  if (channel.type == Type::Float && channel.bytes == 2)
    return half_number(number_at<std::uint16_t>(record + channel.byte, channel.big_endian));
  if (channel.type == Type::Float)
    return channel.bytes == 8 ? number_at<double>(record + channel.byte, channel.big_endian)
                              : number_at<float>(record + channel.byte, channel.big_endian);
  const std::uint64_t bits = stored_bits(channel, record);
  if (channel.type == Type::Unsigned) return static_cast<double>(bits);
  const bool negative = (bits >> (channel.bits - 1)) & 1;
  const std::uint64_t sign = channel.bits == 64 ? 0 : ~std::uint64_t{0} << channel.bits;
  return static_cast<double>(static_cast<std::int64_t>(negative ? bits | sign : bits));
}

/// Pairs of key and value, the keys in ascending order.
double from_table(const std::vector<double>& pairs, double x, bool interpolate) {
  const std::size_t count = pairs.size() / 2;
  if (count == 0) return std::numeric_limits<double>::quiet_NaN();
  std::size_t above = 0;
  for (std::size_t low = 0, high = count; low < high;) {
    const std::size_t middle = (low + high) / 2;
    pairs[2 * middle] < x ? low = middle + 1 : high = middle;
    above = low;
  }

  // Beyond the ends the table goes on as it ends.
  if (above == 0) return pairs[1];
  if (above == count) return pairs[2 * count - 1];
  const double x0 = pairs[2 * above - 2], y0 = pairs[2 * above - 1];
  const double x1 = pairs[2 * above], y1 = pairs[2 * above + 1];
  if (!interpolate) return x - x0 <= x1 - x ? y0 : y1;
  return x1 > x0 ? y0 + (y1 - y0) * (x - x0) / (x1 - x0) : y1;
}

/// Triples of lower end, upper end and value, then the value of all else.
double from_ranges(const std::vector<double>& numbers, double x) {
  for (std::size_t k = 0; k + 2 < numbers.size(); k += 3)
    if (numbers[k] <= x && x <= numbers[k + 1]) return numbers[k + 2];
  return numbers.size() % 3 == 1 ? numbers.back() : std::numeric_limits<double>::quiet_NaN();
}

std::string read_conversion(Mdf4Blocks& blocks, std::uint64_t at, Mdf4Channel& channel);

/// A conversion of some values to texts: the others are numbers where its default, behind the
/// texts, is a conversion.
std::string read_texts(Mdf4Blocks& blocks, const Mdf4Block& block, bool of_ranges,
                       Mdf4Channel& channel) {
  constexpr std::size_t kBeforeTexts = 4, kMostTexts = 1000;  // links; each is tried for each value
  const std::vector<double> ends = std::exchange(channel.conversion.numbers, {});
  const std::size_t texts = of_ranges ? ends.size() / 2 : ends.size();
  const std::uint64_t otherwise = block.link(kBeforeTexts + texts);
  if (texts == 0 || texts > kMostTexts || otherwise == 0 || !channel.texts.empty() ||
      blocks.block(otherwise, "CC TX MD").name != "CC")
    return "its conversion gives texts";

  for (std::size_t k = 0; k < texts; ++k) {
    channel.texts.push_back(of_ranges ? ends[2 * k] : ends[k]);
    channel.texts.push_back(of_ranges ? ends[2 * k + 1] : ends[k]);
  }
  return read_conversion(blocks, otherwise, channel);
}

/// A conversion, or the reason why it is none to a number. The unit where the channel has none.
std::string read_conversion(Mdf4Blocks& blocks, std::uint64_t at, Mdf4Channel& channel) {
  if (at == 0) return {};
  const Mdf4Block block = blocks.block(at, "CC");
  if (channel.unit.empty()) channel.unit = blocks.text(block.link(1));

  constexpr std::size_t kBefore = 24;  // the numbers
  const std::string head = blocks.data(block, kBefore);
  const auto kind = static_cast<unsigned char>(head[0]);
  const auto count = number_at<std::uint16_t>(head.data() + 6);
  const std::string numbers = blocks.data(block, kBefore + 8 * count);
  for (std::size_t k = 0; k < count; ++k)
    channel.conversion.numbers.push_back(number_at<double>(numbers.data() + kBefore + 8 * k));

  // The kinds of the standard, by number; the numbers that each needs at least.
  using Kind = Mdf4Conversion::Kind;
  enum : unsigned char { kValueToText = 7, kRangeToText = 8 };
  struct Row {
    Kind kind;
    std::size_t least;
  };
  constexpr std::array<Row, 7> kKinds{{{Kind::None, 0},
                                       {Kind::Linear, 2},
                                       {Kind::Rational, 6},
                                       {Kind::None, 0},
                                       {Kind::Interpolated, 2},
                                       {Kind::Nearest, 2},
                                       {Kind::Ranges, 3}}};
  if (kind == 3) return "its conversion is a formula";
  if (kind == kValueToText || kind == kRangeToText)
    return read_texts(blocks, block, kind == kRangeToText, channel);
  if (kind >= kKinds.size()) return "its conversion gives texts";
  if (count < kKinds[kind].least) blocks.fail(at, "a conversion without its numbers");
  channel.conversion.kind = kKinds[kind].kind;
  return {};
}

/// Where in a record it lies; the reason when its type is none that is read.
std::string read_place(Mdf4Blocks& blocks, const Mdf4Block& block, const std::string& data,
                       std::uint32_t data_bytes, Mdf4Channel& channel) {
  const auto kind = static_cast<unsigned char>(data[2]);
  if (kind > 5) return "it holds texts, bytes or complex numbers";
  using Type = Mdf4Channel::Type;
  channel.type = std::array{Type::Unsigned, Type::Signed, Type::Float}[kind / 2];
  channel.big_endian = kind % 2 == 1;
  channel.first_bit = static_cast<unsigned char>(data[3]);
  channel.byte = number_at<std::uint32_t>(data.data() + 4);
  channel.bits = number_at<std::uint32_t>(data.data() + 8);

  // What is stored; a bit alone is a state and no measurement.
  if (channel.type == Type::Float && channel.bits != 16 && channel.bits != 32 && channel.bits != 64)
    return "its numbers have " + std::to_string(channel.bits) + " bits";
  if (channel.bits < 4) return "it is a state of " + std::to_string(channel.bits) + " bits";
  if (channel.bits > 64 || channel.first_bit > 7 ||
      (channel.type == Type::Float && channel.first_bit != 0))
    blocks.fail(block.at, "a channel of " + std::to_string(channel.bits) + " bits");
  channel.bytes = (channel.first_bit + channel.bits + 7) / 8;
  if (channel.byte > data_bytes || channel.bytes > data_bytes - channel.byte)
    blocks.fail(block.at, "a channel '" + channel.name + "' that lies beyond its record,");
  return {};
}

}  // namespace

double Mdf4Conversion::operator()(double x) const {
  const auto& p = numbers;
  switch (kind) {
    case Kind::None:
      return x;
    case Kind::Linear:
      return p[0] + p[1] * x;
    case Kind::Rational:
      return (p[0] * x * x + p[1] * x + p[2]) / (p[3] * x * x + p[4] * x + p[5]);
    case Kind::Interpolated:
      return from_table(p, x, true);
    case Kind::Nearest:
      return from_table(p, x, false);
    case Kind::Ranges:
      return from_ranges(p, x);
  }
  return x;
}

double Mdf4Channel::value(const char* record, std::uint64_t number) const {
  const double stored = is_virtual ? static_cast<double>(number) : stored_number(*this, record);
  for (std::size_t k = 0; k + 1 < texts.size(); k += 2)
    if (texts[k] <= stored && stored <= texts[k + 1])
      return std::numeric_limits<double>::quiet_NaN();
  return conversion(stored);
}

Mdf4ChannelOrReason read_mdf4_channel(Mdf4Blocks& blocks, const Mdf4Block& block,
                                      std::uint32_t data_bytes) {
  constexpr std::size_t kData = 72;
  enum : std::uint32_t { kAllInvalid = 1, kInvalidBitValid = 2 };
  enum : unsigned char { kVariableLength = 1, kMaster = 2, kVirtualMaster = 3, kVirtual = 6 };
  const std::string data = blocks.data(block, kData);
  const auto type = static_cast<unsigned char>(data[0]);
  const auto flags = number_at<std::uint32_t>(data.data() + 12);

  // What it is called and in which unit.
  Mdf4ChannelOrReason out;
  Mdf4Channel& channel = out.channel;
  channel.name = blocks.text(block.link(2));
  channel.unit = blocks.text(block.link(6));
  const bool is_master = type == kMaster || type == kVirtualMaster;
  channel.is_time = is_master && data[1] == 1;
  channel.is_virtual = type == kVirtualMaster || type == kVirtual;
  if (flags & kInvalidBitValid) channel.invalid_bit = number_at<std::uint32_t>(data.data() + 16);

  // Whether it is a channel of numbers.
  if (type == kVariableLength) out.reason = "its values have different lengths";
  if (flags & kAllInvalid) out.reason = "all its values are marked invalid";
  if (block.link(1) != 0) out.reason = "it is an array or a structure";
  if (out.reason.empty() && !channel.is_virtual)
    out.reason = read_place(blocks, block, data, data_bytes, channel);
  if (out.reason.empty()) out.reason = read_conversion(blocks, block.link(4), channel);
  if (channel.is_time && channel.unit.empty()) channel.unit = "s";
  return out;
}

}  // namespace dashpot
