#include "dashpot/record/readers/xml_part.h"

#include <expat.h>
#include <new>

#include "dashpot/error.h"

namespace dashpot {
namespace {

std::string_view without_namespace(const char* name) {
  const std::string_view all(name);
  return all.substr(all.find(':') + 1);  // npos + 1 is 0
}

}  // namespace

/// What expat calls.
struct XmlPart::Callbacks {
  static void begin(void* self, const char* name, const char** attributes) {
    guarded(self,
            [&](XmlPart& part) { part.on_begin(without_namespace(name), Attributes(attributes)); });
  }
  static void end(void* self, const char* name) {
    guarded(self, [&](XmlPart& part) { part.on_end(without_namespace(name)); });
  }
  static void text(void* self, const char* data, int size) {
    guarded(self, [&](XmlPart& part) { part.on_text({data, static_cast<std::size_t>(size)}); });
  }
  static void doctype(void* self, const char*, const char*, const char*, int) {
    guarded(self, [](XmlPart& part) {
      throw Error(part.place_, "declares a document type, as no workbook does", "save it anew");
    });
  }

 private:
  /// Runs a step; the first that throws ends the parsing.
  template <class Step>
  static void guarded(void* self, Step step) {
    auto& part = *static_cast<XmlPart*>(self);
    if (part.failure_) return;
    try {
      step(part);
    } catch (...) {
      part.failure_ = std::current_exception();
      XML_StopParser(part.parser_.get(), XML_FALSE);
    }
  }
};

std::string_view XmlPart::Attributes::operator[](std::string_view name) const {
  for (const char** at = pairs_; *at; at += 2)
    if (name == *at) return at[1];
  return {};
}

XmlPart::XmlPart(std::string place)
    : place_(std::move(place)), parser_(XML_ParserCreate(nullptr), XML_ParserFree) {
  if (!parser_) throw std::bad_alloc();
  XML_SetUserData(parser_.get(), this);
  XML_SetElementHandler(parser_.get(), Callbacks::begin, Callbacks::end);
  XML_SetCharacterDataHandler(parser_.get(), Callbacks::text);
  XML_SetStartDoctypeDeclHandler(parser_.get(), Callbacks::doctype);
}

void XmlPart::take(std::string_view block) {
  const auto state =
      XML_Parse(parser_.get(), block.data(), static_cast<int>(block.size()), block.empty());
  if (failure_) std::rethrow_exception(failure_);
  if (state != XML_STATUS_OK)
    throw Error(place_ + ", line " + std::to_string(XML_GetCurrentLineNumber(parser_.get())) +
                    " of its XML",
                std::string("is damaged: ") + XML_ErrorString(XML_GetErrorCode(parser_.get())),
                "copy the file again from its source, or save it anew");
}

}  // namespace dashpot
