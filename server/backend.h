#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "grade/grader.h"
#include "render/renderer.h"
#include "scene/bundle.h"

/// The narrow door between the service and whatever draws. A job is a plain function of bytes and
/// options, so what stands behind the door may be threads, processes or another machine.
namespace farol::server {

/// The work cannot be taken or was not done, through no fault of the client, who may try again.
class Busy : public std::runtime_error {
  public:
    Busy(std::string code, const std::string& message, int retryAfterS)
        : std::runtime_error(message), code_(std::move(code)), retryAfterS_(retryAfterS) {}
    const std::string& code() const { return code_; }  ///< busy.*, worker.*
    int retryAfterS() const { return retryAfterS_; }

  private:
    std::string code_;
    int retryAfterS_;
};

/// A shape to generate and the file format to write it in ("3d", "obj", "ply").
struct MeshJob {
    std::vector<std::string> words;  ///< {"cone", "1", "2", "4", "3"}
    std::string format;
};

/// Which frame of an orbiting client a picture is: only the newest of a session is worth drawing.
struct Turn {
    std::string session;   ///< chosen by the client; empty: not one of a session
    std::int64_t seq = 0;  ///< grows from frame to frame
};

/// A round of pictures: the eye goes about the target once.
struct Turntable {
    int frames = 24;
    double fps = 12.0;
    bool apng = false;  ///< one animated PNG, else multipart/x-mixed-replace
};
inline constexpr const char* kFrameBoundary = "farol-frame";

/// A submission to grade. Where it holds neither a scene nor a picture, the reference's own
/// pictures are asked for.
struct GradeJob {
    grade::Subject reference, submission;
    std::string rubric;  ///< JSON; empty: the default
};

struct GradeReply {
    std::string json;  ///< grade::toJson
    double points = 0, most = 0;
    bool passed = false, refused = false;
    /// JPEG, two a view: the submission's picture and the difference; empty as in ViewGrade. Of a
    /// reference: one a view.
    std::vector<std::string> pictures;
    double readMs = 0, drawMs = 0, compareMs = 0;  ///< stages
};

/// Two pictures, or scenes that are drawn first, to tell the difference of. A scene's job holds the
/// options that it is drawn by; where they give no size and the other is a picture, it is as large.
struct CompareJob {
    grade::Subject first, second;
    std::string crop, mask;  ///< as in docs/http.md
    bool pictures = false;   ///< are wanted too
};

struct CompareReply {
    std::string json;        ///< grade::toJson
    std::string diff, heat;  ///< PNG
};

template <typename Result>
struct Done {
    Result result;
    double queueMs = 0;  ///< time waited for a worker
};

/// Names and values, for /version.
using Layers = std::vector<std::pair<std::string, std::string>>;

/// Where a backend stands, for readiness and metrics.
struct BackendState {
    int workers = 0, busy = 0, queued = 0;
    std::map<std::string, long> restarts;  ///< of workers, by reason, since the start
    long coalesced = 0;                    ///< pictures answered by one being drawn already
    long retried = 0;                      ///< jobs begun again: their worker was killed
    long superseded = 0;                   ///< frames that a newer one of their session overtook
};

/// What draws and what it is kept in.
struct BackendFacts {
    std::string gl;
    Layers sandbox;  ///< layer -> "on" and the like, or "missing: why"
};

/// All calls block until done, may come from many threads at once, and throw farol::Error for the
/// caller's fault and Busy when over capacity; anything else is a fault of ours.
class Backend {
  public:
    virtual ~Backend() = default;
    /// A job that comes while one of the same `tag` (the picture's entity tag) is being drawn
    /// shares its picture. Where `tag` is empty, jobs of the same bytes do; the files of a folder
    /// are not among them. Busy busy.superseded where a newer frame of the same session is known
    /// before this one is begun.
    virtual Done<render::Picture> render(const render::Job& job, const std::string& tag,
                                         const Turn& turn) = 0;
    /// Throws Busy where render() with these would be refused now for want of room.
    virtual void expectRoom(const std::string& tag, const Turn& turn) const = 0;
    virtual Done<render::SceneReport> inspect(const render::Job& job) = 0;
    virtual Done<std::string> mesh(const MeshJob& job) = 0;
    /// The pictures of a turn as one body; the content type is by `turn`.
    virtual Done<render::Picture> turntable(const render::Job& job, const Turntable& turn) = 0;
    /// A picture of a text, by size and format of the options.
    virtual Done<render::Picture> notice(const std::string& text,
                                         const render::PictureOptions& options) = 0;
    /// The files of an archive (scene/archive.h).
    virtual Done<scene::Bundle> unpack(const std::string& archive) = 0;
    virtual Done<GradeReply> grade(const GradeJob& job) = 0;
    virtual Done<CompareReply> compare(const CompareJob& job) = 0;
    /// Draws a tiny known scene and checks its pixels. Throws std::runtime_error with the reason
    /// when they are wrong.
    virtual void check() = 0;
    virtual BackendState state() const = 0;
    virtual BackendFacts facts() const { return {}; }
    /// What draws, for /version and ETags.
    virtual std::string version() const = 0;
};

}  // namespace farol::server
