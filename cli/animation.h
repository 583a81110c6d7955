#pragma once

#include <optional>
#include <string>

#include "cli/confine.h"
#include "image/animation.h"
#include "render/renderer.h"

namespace farol::cli {

/// Columns and rows of a sheet.
struct SheetSize {
    int columns = 0, rows = 0;
    int count() const { return columns * rows; }
};

/// Values of --frames, --fps and --sheet; all unset: a still image.
struct AnimationFlags {
    std::optional<int> frames;
    std::optional<double> fps;
    std::optional<SheetSize> sheet;
    std::optional<int> jobs;  ///< processes that draw
    bool isVideo = false;     ///< the output's name asks for a format of animations alone
    bool isAnyGiven() const { return frames || fps || sheet || isVideo; }
};

/// Reads "4x3", each 1 to kMaxSheetSide. Throws UsageError.
SheetSize sheetSize(const std::string& text);
inline constexpr int kMaxSheetSide = 64;
/// Frames a second of a video where neither --frames nor --fps is given.
inline constexpr double kVideoFps = 24.0;

/// The frames of an animation: frame i shows the time `beginS + i / fps`, seconds.
struct Schedule {
    int frames;
    double fps, beginS;
    double timeOf(int frame) const { return beginS + frame / fps; }
};

/// Given one of --frames and --fps, the other follows from the scene's time range or loop, so that
/// the last frame leads into the first; given both, they are used unchanged. `timeS` is added to
/// every moment. Throws UsageError when the loop is needed and the scene has none.
Schedule schedule(const AnimationFlags& flags, const render::SceneReport& report, double timeS);

/// The format of an animation by the ending of its path, else by the format of its images; nothing
/// for formats without animation.
std::optional<image::AnimationFormat> animationFormat(const std::string& path,
                                                      image::Format format);

/// The share of one of the processes that draw an animation: the frames i with i % count == index.
struct Share {
    int index = 0, count = 1;
};
inline constexpr int kMaxDrawingProcesses = 64;

/// Returns how many processes to start for an animation: the number that was asked for, else a
/// core each where the number of frames is unknown or large enough.
int drawingProcesses(const AnimationFlags& flags);

/// Returns the share of a process, of those that were started: 0 is the one that encodes, which
/// draws the last frame. A process without frames has an index of at least `frames`.
Share shareOf(int process, const AnimationFlags& flags, int frames);

/// Shares the processor between the processes that draw: to be called before the first Renderer of
/// each. A value of LP_NUM_THREADS in the environment stays.
void shareProcessor(int processes);

/// Renders all frames into the first output, at `path`: one animation, or, with a %d (%04d) in it,
/// one image a frame. Encodes a frame while the next one is drawn. Draws its own share; the frames
/// of other shares come from the helpers of `outputs` in their order, and are drawn here where a
/// helper has ended, with a warning in the report. The bytes do not depend on the shares. Holds at
/// most five frames, each helper as well. Shows progress on stderr unless the report is JSON.
/// Returns the last image.
render::Picture renderAnimation(render::Job job, const Schedule& schedule, const Share& share,
                                const std::string& path, Outputs& outputs, render::GlSource gl,
                                Report& report);

/// Draws the frames of a share and sends them over `socket`.
void helpAnimation(render::Job job, const Schedule& schedule, const Share& share, int socket,
                   render::GlSource gl);

/// Renders one image of many into the first output: the frames of the schedule, or without one
/// views from all sides. Throws Error limit.pixels where it would be too large. Shows progress as
/// renderAnimation does.
render::Picture renderSheet(render::Job job, const SheetSize& size,
                            const std::optional<Schedule>& schedule, Outputs& outputs,
                            render::GlSource gl, const Report& report);

}  // namespace farol::cli
