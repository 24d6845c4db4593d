#pragma once
#include <span>
#include <string>
#include <string_view>

/// The readers of what comes from outside, each as a function of bytes.
namespace bladefit::fuzz {

/// What a reader made of an input.
struct Answer {
  std::string refusal;  ///< the line that says why it was refused; empty = it was read
  std::string broken;   ///< a promise of the reader that does not hold; empty = all hold
};

struct Reader {
  std::string_view name;  ///< of its folder in the corpus
  Answer (*read)(std::string_view bytes);
  /// Puts right the check sums of a changed input, so that what they protect is reached; null where there are none.
  void (*repair)(std::string& bytes);
};

[[nodiscard]] std::span<const Reader> readers();

// One row each, in the sources of what they read.
extern const Reader kPoints, kReadout, kSerial, kDeviceFile, kSessionFile, kZonesFile,
    kStartPairs;                                               // reader_of_text.cpp
extern const Reader kStep, kIges, kJournal, kSalvage, kImage;  // reader_of_files.cpp

/// A refusal is one line of printed characters, and does not speak of the language that this is written in.
[[nodiscard]] std::string broken_words(const std::string& refusal);

}  // namespace bladefit::fuzz
