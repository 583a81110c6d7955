#include "worker/jobs.h"

#include <algorithm>
#include <new>

#include "worker/job.h"
#include "worker/tasks/table.h"

namespace farol::worker {
namespace {

constexpr std::size_t kMaxFault = 2'000;  // bytes of a message: a shader's log may be longer

std::string runTask(WorkerState& state, std::string_view job) {
    Unpacker unpacker(job);
    std::string name;
    unpacker(name);
    for (const TaskEntry& task : tasks())
        if (task.name == name) return task.run(unpacker, state);
    throw WireError("there is no task " + name);
}

}  // namespace

std::string work(WorkerState& state, std::string_view job) {
    AnswerHead head;
    try {
        return runTask(state, job);
    } catch (const Error& error) {
        head.outcome = Outcome::refused;
        head.diagnostics = error.diagnostics();
    } catch (const Cancelled&) {
        head.outcome = Outcome::cancelled;
    } catch (const std::bad_alloc&) {
        head.outcome = Outcome::memory;
    } catch (const std::exception& fault) {
        head.outcome = Outcome::broken;
        head.message = std::string(fault.what()).substr(0, kMaxFault);
    }
    return pack(head);
}

}  // namespace farol::worker
