#include "tools/report/pdf_report.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

#include "tools/files/read_text.hpp"
#include "tools/files/run_program.hpp"
#include "tools/files/tool_error.hpp"
#include "tools/report/html_report.hpp"

namespace bladefit {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kLongestPrint{300};
constexpr std::array<const char*, 4> kChromiums = {"chromium", "chromium-browser", "google-chrome",
                                                   "google-chrome-stable"};

/// A folder of its own that is gone afterwards.
class PrintFolder {
 public:
  PrintFolder() {
    std::string name = (fs::temp_directory_path() / "bladefit-print-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw ToolError(fmt::format("{}: no folder can be made there; set TMPDIR to one that can be written", name),
                      ToolError::Kind::device);
    }
    path_ = name;
  }
  ~PrintFolder() {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  PrintFolder(const PrintFolder&) = delete;
  PrintFolder& operator=(const PrintFolder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// A program that prints, with what it is told.
struct Printer {
  std::string path;
  std::vector<std::string> arguments;
};

std::vector<std::string> chromium_arguments(const fs::path& folder) {
  std::vector<std::string> arguments = {"--headless",
                                        "--disable-gpu",
                                        "--disable-extensions",
                                        "--disable-dev-shm-usage",
                                        "--no-first-run",
                                        "--no-pdf-header-footer",
                                        "--user-data-dir=" + (folder / "profile").string(),
                                        "--print-to-pdf=" + (folder / "report.pdf").string()};
  // Its sandbox does not start for the superuser; the page has no script and asks for nothing.
  if (geteuid() == 0) arguments.emplace_back("--no-sandbox");
  arguments.push_back("file://" + (folder / "report.html").string());
  return arguments;
}

Printer printer_for(const fs::path& folder) {
  for (const char* const name : kChromiums) {
    if (const auto path = find_program(name)) return {*path, chromium_arguments(folder)};
  }
  throw ToolError(
      "--format pdf: Chromium is not installed; install it (apt-get install chromium), or write "
      "html and print that",
      ToolError::Kind::device);
}

}  // namespace

std::string pdf_report(const Result& result) {
  const PrintFolder folder;
  const Printer printer = printer_for(folder.path());
  std::ofstream(folder.path() / "report.html", std::ios::binary) << html_report(result);
  const std::optional<int> code = run_program(printer.path, printer.arguments, kLongestPrint);
  std::error_code error;
  const fs::path printed = folder.path() / "report.pdf";
  if (code == 0 && fs::file_size(printed, error) > 0 && !error) return read_text(printed, "printed report");
  throw ToolError(fmt::format("{}: printed nothing ({}); write html and print that", printer.path,
                              code ? fmt::format("exit code {}", *code)
                                   : fmt::format("not ended after {} s", kLongestPrint.count())),
                  ToolError::Kind::device);
}

}  // namespace bladefit
