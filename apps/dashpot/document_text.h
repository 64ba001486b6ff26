#pragma once
#include "console.h"
#include "dashpot/report/document.h"

namespace dashpot::cli {

/// What a document says and its tables, for a terminal; figures are left to the page.
void print_document(const Document& document, Console& console);

}  // namespace dashpot::cli
