#pragma once

#include <string>

#include "image/image.h"

namespace farol::image {

/// Writes an animated PNG (PNG specification, 3rd edition, section 11.3.6) that loops for ever.
/// All frames have the size of the first; viewers without animation show the first.
class ApngWriter {
  public:
    /// frames >= 1, 0 < fps <= 1000. alpha: keep transparency.
    ApngWriter(int frames, double fps, bool alpha);
    /// Throws std::invalid_argument when the size differs or there are too many frames.
    void add(const Image& frame);
    /// Returns the file. Throws std::logic_error when frames are missing.
    std::string finish();

  private:
    std::string out_;
    int frames_, added_ = 0, width_ = 0, height_ = 0;
    double fps_;
    int channels_;
    unsigned sequence_ = 0;
};

}  // namespace farol::image
