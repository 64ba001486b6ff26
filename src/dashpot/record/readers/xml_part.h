#pragma once
#include <exception>
#include <memory>
#include <string>
#include <string_view>

struct XML_ParserStruct;

namespace dashpot {

/// A part of XML that is understood block by block: memory does not grow with it. What is derived
/// from it takes the elements and texts, by names without their namespaces; what it throws ends the
/// reading. A document type is refused: its entities can refer to each other without end.
class XmlPart {
 public:
  /// `place` is named in errors.
  explicit XmlPart(std::string place);
  virtual ~XmlPart() = default;
  XmlPart(const XmlPart&) = delete;
  XmlPart& operator=(const XmlPart&) = delete;

  /// The next block of the part; an empty one is its end. Throws Error(place, ...) on damage.
  void take(std::string_view block);

 protected:
  class Attributes {
   public:
    explicit Attributes(const char** pairs) : pairs_(pairs) {}
    std::string_view operator[](std::string_view name) const;  ///< "" where there is none

   private:
    const char** pairs_;
  };
  virtual void on_begin(std::string_view name, const Attributes& attributes) = 0;
  virtual void on_end(std::string_view name) = 0;
  virtual void on_text(std::string_view text) = 0;

  const std::string place_;

 private:
  struct Callbacks;

  std::unique_ptr<XML_ParserStruct, void (*)(XML_ParserStruct*)> parser_;
  std::exception_ptr failure_;  ///< waits beside the parser, which is C
};

}  // namespace dashpot
