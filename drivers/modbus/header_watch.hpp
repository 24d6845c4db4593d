#pragma once
#include <algorithm>
#include <cstdint>

namespace bladefit {

/// What the headers in a row say of the device. A header has no check sum, so that one alone proves nothing.
class HeaderWatch {
 public:
  static constexpr int kOfAnotherRun = 2;  ///< headers in a row that prove another run
  static constexpr int kRefused = 3;       ///< a refused header may have been damaged on its way
  static constexpr int kToOpen = 3;        ///< one to know the device by, two to see the run that the start has begun

  /// `run_id` is that of the records taken so far.
  void restart(std::uint32_t run_id) {
    *this = HeaderWatch();
    run_id_ = run_id;
  }

  /// The link is new.
  void link_made() { refused_ = 0; }

  /// True when headers have been refused often enough to believe it.
  [[nodiscard]] bool refuse() { return ++refused_ >= kRefused; }

  /// A good header of `run_id`. `counts`: it can show the run that the start begins, which a device that still refuses
  /// the start cannot.
  void accept(std::uint32_t run_id, bool records_taken, bool counts) {
    refused_ = 0;
    if (counts) good_ = std::min(good_ + 1, kToOpen);
    foreign_ = records_taken && run_id != run_id_ ? foreign_ + 1 : 0;
  }

  /// No record was taken yet: whatever run the device is in is the run of this session.
  void adopt(std::uint32_t run_id) { run_id_ = run_id; }

  [[nodiscard]] bool enough_to_open() const { return good_ >= kToOpen; }

  /// The last header was of another run than the records taken so far: it must not be told that any of its own are
  /// stored. A device without run ids always shows 0.
  [[nodiscard]] bool foreign() const { return foreign_ > 0; }
  [[nodiscard]] bool surely_foreign() const { return foreign_ >= kOfAnotherRun; }

 private:
  std::uint32_t run_id_ = 0;
  int good_ = 0;     ///< good ones since open(), as far as open() counts them
  int foreign_ = 0;  ///< in a row, of another run
  int refused_ = 0;  ///< in a row
};

}  // namespace bladefit
