#pragma once
#include <string>

namespace dashpot {

/// Throws Error, naming the package, where no browser is installed that prints pages: asked before
/// long work.
void require_browser();

/// A page as PDF, printed by a browser without a window and without the network, within two
/// minutes. Throws Error with its words where it fails.
std::string pdf_of_page(const std::string& html);

}  // namespace dashpot
