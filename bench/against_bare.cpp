// Warm frames plus PNG against the bare loop, turn by turn in one run:
//   bench_against_bare SCENE.xml [--runs N] [--json] [--save STEM] [name=value ...]
// Each side has its own process, so that neither sees the other's GL settings.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <stdexcept>

#include "bench/bare_loop.h"
#include "bench/measure.h"
#include "image/image_file.h"
#include "render/gl/context.h"
#include "render/plan/instances.h"
#include "render/plan/plan.h"
#include "render/prepare.h"

using namespace farol;

namespace {

/// Runs `frame` in a child process each time a byte comes; answers with its milliseconds.
class Side {
  public:
    explicit Side(const std::function<std::function<std::string()>()>& make,
                  const std::string& save) {
        int toChild[2], fromChild[2];
        if (pipe(toChild) != 0 || pipe(fromChild) != 0) throw std::runtime_error("no pipe");
        child_ = fork();
        if (child_ < 0) throw std::runtime_error("no process");
        if (child_ == 0) {
            close(toChild[1]);
            close(fromChild[0]);
            _exit(serve(make, save, toChild[0], fromChild[1]));
        }
        close(toChild[0]);
        close(fromChild[1]);
        to_ = toChild[1];
        from_ = fromChild[0];
    }
    ~Side() {
        close(to_);
        close(from_);
        waitpid(child_, nullptr, 0);
    }
    Side(const Side&) = delete;
    Side& operator=(const Side&) = delete;

    double frameMs() const {
        double ms = 0.0;
        if (write(to_, "f", 1) != 1 || read(from_, &ms, sizeof ms) != sizeof ms)
            throw std::runtime_error("a side ended; see above");
        return ms;
    }

  private:
    static int serve(const std::function<std::function<std::string()>()>& make,
                     const std::string& save, int in, int out) try {
        const std::function<std::string()> frame = make();
        const std::string first = frame();
        if (!save.empty()) std::ofstream(save, std::ios::binary) << first;
        for (char order = 0; read(in, &order, 1) == 1;) {
            farol::Stopwatch watch;
            frame();
            const double ms = watch.lapMs();
            if (write(out, &ms, sizeof ms) != sizeof ms) return 1;
        }
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_against_bare: %s\n", error.what());
        return 1;
    }
    pid_t child_ = -1;
    int to_ = -1, from_ = -1;
};

}  // namespace

int main(int count, char** arguments) try {
    bench::Arguments given = bench::Arguments::parse(count, arguments);
    const render::Job job = bench::jobOf(given);
    const auto ours = [&job] {
        auto renderer = std::make_shared<render::Renderer>();
        return [renderer, &job] { return renderer->render(job).bytes; };
    };
    const auto bare = [&job] {
        const render::Prepared prepared = render::prepare(job);
        render::MeshLibrary meshes(std::size_t{256} << 20);
        const render::FramePlan plan =
            render::plan(prepared.scene,
                         render::place(prepared.scene, job.options.timeS, job.options.curves,
                                       *prepared.assets, meshes),
                         job.options, *prepared.assets, meshes,
                         render::gl::createContext(render::GlSource::automatic)->facts());
        std::vector<image::Image> textures;
        for (const render::TextureRef& ref : plan.textures) {
            if (ref.chess || ref.cube) throw std::runtime_error("the bare loop takes pictures");
            textures.push_back(
                image::decodeImage(prepared.assets->read(ref.path).value_or(""), ref.path));
        }
        auto loop = std::make_shared<bench::BareLoop>(plan, textures);
        return [loop] { return loop->frame(); };
    };
    const bool save = !given.save.empty();
    const Side a(ours, save ? given.save + "-farol.png" : "");
    const Side b(bare, save ? given.save + "-bare.png" : "");
    std::vector<double> oursMs, bareMs, ratios;
    for (int i = 0; i < 3; ++i) {  // lets clocks and caches settle
        a.frameMs();
        b.frameMs();
    }
    for (int i = 0; i < given.runs; ++i) {
        // The order changes from run to run: neither side always comes second.
        if (i % 2 == 0) oursMs.push_back(a.frameMs());
        bareMs.push_back(b.frameMs());
        if (i % 2 != 0) oursMs.push_back(a.frameMs());
        ratios.push_back(oursMs.back() / bareMs.back());
    }
    const char* text = given.json
                           ? "{\"bench\": \"against_bare\", \"runs\": %d, \"farolMs\": %.3f, "
                             "\"bareMs\": %.3f, \"ratio\": %.3f, \"medianOfRatios\": %.3f}\n"
                           : "%d runs: farol %.2f ms, bare loop %.2f ms, ratio of medians %.3f, "
                             "median of ratios %.3f\n";
    std::printf(text, given.runs, bench::median(oursMs), bench::median(bareMs),
                bench::median(oursMs) / bench::median(bareMs), bench::median(ratios));
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "bench_against_bare: %s\n", error.what());
    return 1;
}
