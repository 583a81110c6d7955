#pragma once

#include "core/message.h"

namespace farol::image {

inline constexpr MessageRow kImageMessages[] = {
    {"image.unreadable",
     "cannot read image \"{name}\": {reason}",
     {"brick.png", "PNG: the file is cut off"}},
    {"image.unreadable/empty", "cannot read image \"{name}\": the file is empty", {"brick.png"}},
    {"image.unreadable/format",
     "cannot read image \"{name}\": unknown format; expected PNG, JPEG, WebP, GIF, BMP, TGA, PNM, "
     "Radiance HDR, OpenEXR or TIFF. Save the image as PNG",
     {"brick.svg"}},
    {"image.unreadable/lfs",
     "cannot read image \"{name}\": it is a pointer of Git LFS, not the image; run git lfs pull "
     "and "
     "send the image",
     {"brick.png"}},
    {"image.unreadable/page",
     "cannot read image \"{name}\": it is a web page, not the image; save the image itself",
     {"brick.jpg"}},
    {"limit.texture",
     "image \"{name}\" is {size}; expected at most {max} million pixels. Scale the image down",
     {"brick.png", "20000 x 20000 px", "64"}},
    {"option.unavailable",
     "format \"{format}\" needs the video module, which cannot be loaded: {reason}; build with "
     "-DFAROL_VIDEO=ON and install it, or choose gif, apng or animated-webp",
     {"mp4", "libfarol_video.so: cannot open shared object file"}},
};

/// A message of this floor's table.
template <FixedString kId, FixedString... kNames>
Message message(const NamedArgument<kNames>&... arguments) {
    return makeMessage<kId, kImageMessages>(arguments...);
}

}  // namespace farol::image
