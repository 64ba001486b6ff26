#include "dashpot/record/readers/stored_arrays.h"

#include <utility>

#include "dashpot/error.h"

namespace dashpot {
namespace {

/// Counted up whenever what follows it changes, so that programs of two installations see it.
constexpr std::string_view kStoredGreeting = "dashpot-hdf5 1";

constexpr char kStoredArray = 'A', kStoredNote = 'N', kStoredFile = 'B', kStoredEnd = 'E',
               kStoredFailure = 'F';

/// Takes pieces as long as they are there and within what may come.
class StoredReader {
 public:
  StoredReader(const TakeBytes& take, std::size_t most_bytes) : take_(take), left_(most_bytes) {}

  bool bytes(void* to, std::size_t count) {
    if (count > left_) return false;
    left_ -= count;
    return take_(to, count) == count;
  }
  template <class Number>
  bool number(Number& to) {
    return bytes(&to, sizeof to);
  }
  bool text(std::string& to) {
    std::size_t size = 0;
    if (!number(size) || size > left_) return false;
    to.resize(size);
    return bytes(to.data(), size);
  }
  bool greeting() {
    std::string text_there;
    return text(text_there) && text_there == kStoredGreeting;
  }
  /// What comes next. Throws the Error that the other end met.
  bool mark(char& to) {
    if (!bytes(&to, 1)) return false;
    std::string message;
    if (to == kStoredFailure && text(message)) throw Error("", message);
    return true;
  }
  bool array(StoredArray& to);

 private:
  const TakeBytes& take_;
  std::size_t left_;
};

bool StoredReader::array(StoredArray& to) {
  if (!text(to.group) || !text(to.name) || !text(to.unit) || !number(to.height) ||
      !number(to.width) || to.height == 0 || to.width == 0)
    return false;
  if (to.is_wide()) return true;

  // Room for them only once it is known that so many may come.
  const std::size_t columns = std::min(to.height, to.width);
  if (to.length() > left_ / sizeof(double) / columns) return false;
  to.columns.resize(columns);
  for (std::vector<double>& column : to.columns) {
    column.resize(to.length());
    if (!bytes(column.data(), column.size() * sizeof(double))) return false;
  }
  return true;
}

}  // namespace

std::size_t most_stored_bytes(std::uintmax_t file_size) {
  constexpr std::uintmax_t kAlways = std::uintmax_t{64} << 20, kPerByte = 12;
  return static_cast<std::size_t>(std::max(kAlways, kPerByte * file_size));
}

StoredWriter::StoredWriter(GiveBytes give) : give_(std::move(give)) { put(kStoredGreeting); }

void StoredWriter::put(std::string_view text) {
  const std::size_t size = text.size();
  give_(&size, sizeof size);
  give_(text.data(), size);
}

void StoredWriter::begin_array(const StoredArray& about) {
  give_(&kStoredArray, 1);
  for (const std::string& text : {about.group, about.name, about.unit}) put(text);
  for (const std::size_t side : {about.height, about.width}) give_(&side, sizeof side);
}

void StoredWriter::note(const StoredNote& note) {
  give_(&kStoredNote, 1);
  put(note.group);
  put(note.text);
}

void StoredWriter::file(std::string_view bytes) {
  give_(&kStoredFile, 1);
  put(bytes);
}

void StoredWriter::end() { give_(&kStoredEnd, 1); }

void StoredWriter::fail(std::string_view message) {
  give_(&kStoredFailure, 1);
  put(message);
}

bool take_stored_arrays(const TakeBytes& take, std::size_t most_bytes, StoredArrays& to) {
  StoredReader reader(take, most_bytes);
  if (!reader.greeting()) return false;
  for (char mark = 0; reader.mark(mark);) {
    bool is_whole = false;
    if (mark == kStoredEnd) return true;
    if (mark == kStoredArray) is_whole = reader.array(to.arrays.emplace_back());
    if (mark == kStoredNote)
      is_whole = reader.text(to.notes.emplace_back().group) && reader.text(to.notes.back().text);
    if (!is_whole) return false;
  }
  return false;
}

bool take_stored_file(const TakeBytes& take, std::string& to) {
  constexpr std::size_t kMostOfAnArray = std::size_t{1} << 32;
  StoredReader reader(take, kMostOfAnArray);
  char mark = 0;
  return reader.greeting() && reader.mark(mark) && mark == kStoredFile && reader.text(to) &&
         reader.mark(mark) && mark == kStoredEnd;
}

}  // namespace dashpot
