#pragma once

#include "core/message.h"

namespace farol::worker {

inline constexpr MessageRow kWorkerMessages[] = {
    {"busy.cancelled", "the client has closed the connection; the rest is not drawn"},
    {"busy.deadline", "the work was not done in time; try again later"},
    {"busy.deadline/processor",
     "the worker got too little processor time before the deadline; try again later"},
    {"busy.draining", "the server is shutting down; try again in a moment"},
    {"busy.queue", "all workers are busy and the queue is full; try again later"},
    {"busy.queue/wait", "no worker became free in time; try again later"},
    {"busy.superseded", "a newer frame of this session was requested"},
    {"limit.cpu",
     "the request used more processor time than allowed; use fewer pixels, samples, lights or "
     "triangles"},
    {"limit.memory",
     "the scene needs more memory than a worker may use ({max} MiB); use smaller images or meshes",
     {"512"}},
    {"limit.triangles/mesh",
     "the mesh would have {count} triangles; expected at most {max}; use fewer divisions",
     {"300000", "250000"}},
    {"option.range/frames",
     "frames times width times height is {value}; expected at most {max}",
     {"99000000", "64000000"}},
    {"option.range/loop-frames",
     "one loop of the scene takes {seconds} s and has {value} frames at this rate; expected 2 to "
     "{max}; give \"frames\", or another \"fps\"",
     {"60", "720", "120"}},
    {"option.range/loop-none",
     "the scene has no loop shorter than an hour; give it a time range, as in <render time=\"0 "
     "10\"/>, or use over=camera"},
    {"option.range/loop-still", "nothing moves in this scene; use over=camera"},
    {"option.range/mesh-format", "format \"{value}\" is unknown; expected 3d, obj or ply", {"stl"}},
    {"worker.crashed", "the worker that had this request crashed"},
    {"worker.crashed/start", "no worker could be started for this request; try again later"},
    {"worker.killed", "the workers that had this request were ended; try again"},
    {"worker.quarantine",
     "this request ended two workers in a row; it is refused for the next {seconds} s",
     {"60"}},
    {"worker.quarantine/scene",
     "three different requests for this scene crashed a worker; it is refused for the next "
     "{seconds} s",
     {"60"}},
    {"worker.reply", "the worker that had this request sent an invalid reply; try again"},
};

/// A message of this floor's table.
template <FixedString kId, FixedString... kNames>
Message message(const NamedArgument<kNames>&... arguments) {
    return makeMessage<kId, kWorkerMessages>(arguments...);
}

}  // namespace farol::worker
