#pragma once
#include <filesystem>
#include <httplib.h>
#include <string>

#include "dashpot/value.h"
#include "sample_view.h"

// What requests and answers of the studio are made of.
namespace dashpot::studio {

void answer(httplib::Response& response, const Value& value, int status = 200);
void refuse(httplib::Response& response, int status, const std::string& why);

/// The JSON of a request's body. Throws Error where it is none, or longer than any the page sends.
Value body_of(const httplib::Request& request);
/// A number of a query; `fallback` where it is missing. Throws Error where it is none.
double number_of(const httplib::Request& request, const char* name, double fallback);

/// {"x": [...], "y": [...]} of ?record=0&x=time&y=force&from=&to=&width=800, as few points as a
/// picture of that width needs.
void draw(const SampleView& view, const httplib::Request& request, httplib::Response& response);

/// A report page, shut in: it has an origin of its own and reaches nothing.
void answer_report(httplib::Response& response, const std::filesystem::path& page);

}  // namespace dashpot::studio
