#pragma once
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

// A small writer of TDMS files, for tests and as seeds of fuzzing.

/// Takes numbers in one of the two orders of bytes.
class TdmsBytes {
 public:
  explicit TdmsBytes(bool big_endian = false) : big_endian_(big_endian) {}

  template <class Number>
  TdmsBytes& add(Number value) {
    char raw[sizeof(Number)];
    std::memcpy(raw, &value, sizeof(Number));
    if (big_endian_) std::reverse(raw, raw + sizeof(Number));
    bytes.append(raw, sizeof(Number));
    return *this;
  }
  TdmsBytes& text(const std::string& text) {
    add<std::uint32_t>(static_cast<std::uint32_t>(text.size()));
    bytes += text;
    return *this;
  }

  std::string bytes;

 private:
  bool big_endian_;
};

enum TdmsContents : std::uint32_t {
  kTdmsMetadata = 2,
  kTdmsNewList = 4,
  kTdmsRawData = 8,
  kTdmsInterleaved = 32,
  kTdmsBigEndian = 64,
  kTdmsDaqmx = 128
};

/// One segment; a stated length of nothing is that of a writer which never closed it.
inline std::string tdms_segment(std::uint32_t contents, const std::string& metadata,
                                const std::string& raw, bool closed = true) {
  TdmsBytes lead(contents & kTdmsBigEndian);
  lead.add<std::uint32_t>(4713);
  lead.add<std::uint64_t>(closed ? metadata.size() + raw.size() : ~std::uint64_t{0});
  lead.add<std::uint64_t>(metadata.size());
  return "TDSm" + TdmsBytes().add(contents).bytes + lead.bytes + metadata + raw;
}

using TdmsTexts = std::vector<std::pair<std::string, std::string>>;
using TdmsNumbers = std::vector<std::pair<std::string, double>>;

/// The end of an object's metadata: its properties.
inline void add_tdms_properties(TdmsBytes& bytes, const TdmsTexts& texts,
                                const TdmsNumbers& numbers) {
  bytes.add<std::uint32_t>(static_cast<std::uint32_t>(texts.size() + numbers.size()));
  for (const auto& [name, value] : texts) bytes.text(name).add<std::uint32_t>(0x20).text(value);
  for (const auto& [name, value] : numbers) {
    const bool is_count =
        name.ends_with("Size") || name.ends_with("Source") || name.ends_with("Of_Scales");
    bytes.text(name).add<std::uint32_t>(is_count ? 7 : 10);
    is_count ? bytes.add(static_cast<std::uint32_t>(value)) : bytes.add(value);
  }
}

/// A channel with `values` values of a type in each chunk.
inline void add_tdms_channel(TdmsBytes& bytes, const std::string& path, std::uint32_t type,
                             std::uint64_t values, const TdmsTexts& texts = {},
                             const TdmsNumbers& numbers = {}) {
  bytes.text(path).add<std::uint32_t>(20).add(type).add<std::uint32_t>(1).add(values);
  add_tdms_properties(bytes, texts, numbers);
}

/// A recording of displacement (mm, double) and force (0.1 N as 16 bits), `values` in a chunk.
inline std::string example_tdms(bool interleaved, bool big_endian, int chunks = 2, int values = 20,
                                bool closed = true, std::size_t cut = 0) {
  TdmsBytes metadata(big_endian);
  metadata.add<std::uint32_t>(2);
  const auto count = static_cast<std::uint64_t>(values);
  add_tdms_channel(metadata, "/'run'/'displacement'", 10, count, {{"unit_string", "mm"}},
                   {{"wf_increment", 0.01}});
  add_tdms_channel(metadata, "/'run'/'force'", 2, count,
                   {{"unit_string", "N"}, {"NI_Scale[0]_Scale_Type", "Linear"}},
                   {{"wf_increment", 0.01},
                    {"NI_Number_Of_Scales", 1},
                    {"NI_Scale[0]_Linear_Slope", 0.1},
                    {"NI_Scale[0]_Linear_Y_Intercept", 2}});

  const auto displacement = [](int k) { return 1.5 * (k % 7); };
  const auto force = [](int k) { return static_cast<std::int16_t>(100 * (k % 5) - 200); };
  TdmsBytes raw(big_endian);
  for (int chunk = 0; chunk < chunks; ++chunk) {
    const int first = values * chunk;
    if (interleaved)
      for (int k = 0; k < values; ++k) raw.add(displacement(first + k)).add(force(first + k));
    for (int k = 0; !interleaved && k < values; ++k) raw.add(displacement(first + k));
    for (int k = 0; !interleaved && k < values; ++k) raw.add(force(first + k));
  }
  raw.bytes.resize(raw.bytes.size() - cut);
  std::uint32_t contents = kTdmsMetadata | kTdmsNewList | kTdmsRawData;
  if (interleaved) contents |= kTdmsInterleaved;
  if (big_endian) contents |= kTdmsBigEndian;
  return tdms_segment(contents, metadata.bytes, raw.bytes, closed);
}

/// Two channels of DAQmx in rows of 6 bytes: 16 bits at 0, 32 bits at 2.
inline std::string example_tdms_daqmx() {
  TdmsBytes metadata;
  metadata.add<std::uint32_t>(2);
  const auto channel = [&](const std::string& path, std::uint32_t type, std::uint32_t offset,
                           const TdmsTexts& texts, const TdmsNumbers& numbers) {
    metadata.text(path).add<std::uint32_t>(0x1269).add<std::uint32_t>(0xFFFFFFFF);
    metadata.add<std::uint32_t>(1).add<std::uint64_t>(3);
    metadata.add<std::uint32_t>(1);  // scalers
    metadata.add(type).add<std::uint32_t>(0).add(offset).add<std::uint32_t>(0);
    metadata.add<std::uint32_t>(0);
    metadata.add<std::uint32_t>(1).add<std::uint32_t>(6);  // buffers and their rows
    add_tdms_properties(metadata, texts, numbers);
  };
  channel("/'daq'/'x'", 3, 0,
          {{"NI_Scale[1]_Scale_Type", "Polynomial"}, {"NI_Scaling_Status", "unscaled"}},
          {{"NI_Number_Of_Scales", 2},
           {"NI_Scale[1]_Polynomial_Coefficients_Size", 3},
           {"NI_Scale[1]_Polynomial_Coefficients[0]", 1},
           {"NI_Scale[1]_Polynomial_Coefficients[1]", 0.5},
           {"NI_Scale[1]_Polynomial_Coefficients[2]", 0.25},
           {"NI_Scale[1]_Polynomial_Input_Source", 0},
           {"wf_increment", 0.05}});
  channel("/'daq'/'F'", 5, 2, {}, {{"NI_Number_Of_Scales", 1}, {"wf_increment", 0.05}});
  TdmsBytes raw;
  for (int k = 0; k < 6; ++k)
    raw.add<std::int16_t>(static_cast<std::int16_t>(k - 2)).add<std::int32_t>(70000 * k);
  return tdms_segment(kTdmsMetadata | kTdmsNewList | kTdmsRawData | kTdmsDaqmx, metadata.bytes,
                      raw.bytes);
}
