#pragma once

#include <catch2/catch.hpp>
#include <functional>
#include <string>

#include "tests/support/pool_process.h"
#include "worker/pool.h"
#include "worker/tasks/render.h"

namespace farol::test {

inline worker::EventLog noLog() {
    return [](const std::string&, const std::string&) {};
}

/// A pool of one worker that does what a job's document names (tests/fake_worker).
inline worker::PoolOptions fakeOptions() {
    worker::PoolOptions options;
    options.workers = 1;
    options.spares = 0;
    options.queue = {16, std::chrono::seconds(60), std::chrono::seconds(60)};
    options.worker.program = FAKE_WORKER;
    return options;
}

/// A job of 32 x 32 px. Its first line is what the fake worker does; `variant` tells requests for
/// the same scene apart.
inline render::Job jobOf(const std::string& deed, int variant = 1) {
    render::Job job;
    job.xml = deed;
    job.assets = std::make_shared<scene::BundleAssets>();
    job.options.width = job.options.height = 32;
    job.options.quality = variant;
    return job;
}

/// "done", or the code of what was thrown.
inline std::string codeOf(const std::function<void()>& work) {
    try {
        work();
        return "done";
    } catch (const worker::Busy& busy) {
        return busy.code();
    } catch (const Error& error) {
        return error.code();
    }
}

inline std::string renderCode(worker::WorkerPool& pool, const std::string& deed, int variant = 1) {
    return codeOf([&] { pool.run<worker::RenderTask>({jobOf(deed, variant)}); });
}

inline long restarts(const worker::WorkerPool& pool, const std::string& reason) {
    const auto all = pool.state().restarts;
    const auto found = all.find(reason);
    return found == all.end() ? 0 : found->second;
}

}  // namespace farol::test
