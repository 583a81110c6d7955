// Bodies with scenes: the input's first line is the Content-Type, the rest is the body.
#include "server/request/multipart.h"
#include "server/request/parameters.h"
#include "server/request/upload.h"
#include "tests/fuzz/checks.h"
#include "tests/fuzz/target.h"
#include "tests/support/errors.h"

namespace farol::fuzz {
namespace {

class Bytes final : public server::http::Body {
  public:
    explicit Bytes(std::string bytes) : bytes_(std::move(bytes)) {}
    std::string read(std::size_t maxBytes) override {
        if (bytes_.size() > maxBytes) throw test::errorOf("limit.body", "the body is too large");
        return std::move(bytes_);
    }

  private:
    std::string bytes_;
};

void checkUpload(const server::Upload& upload) {
    if (!upload.bundle) {  // a worker opens it: fuzz_archive
        require(!upload.job.archive.empty(), "neither a scene nor an archive");
        return;
    }
    require(!upload.job.xml.empty(), "a scene without bytes");
    require(upload.job.assets != nullptr, "an upload without files");
    for (const std::string& path : upload.job.assets->list()) {
        require(scene::isSafePath(path), "a path that leads out of the bundle: " + path);
        require(path.find_first_of(std::string("\0\r\n", 3)) == std::string::npos,
                "a control character in a path");
        require(upload.job.assets->read(path).has_value(), "a file that is listed and not there");
    }
    if (upload.optionsJson.empty()) return;
    server::ParameterRules rules;
    rules.picture = true;
    server::readParameters({}, rules, upload.optionsJson);
}

}  // namespace

const Target& target() {
    static const Target made{
        {"txt"},
        {"--b\r\n",
         "\r\n--b\r\n",
         "\r\n--b--\r\n",
         "\r\n\r\n",
         "\r\n",
         "Content-Disposition: form-data; name=\"scene\"; filename=\"s.xml\"\r\n",
         "Content-Disposition: form-data; name=\"options\"\r\n",
         "; name=\"",
         "; filename=\"",
         "Content-Type: image/png\r\n",
         "Content-Transfer-Encoding: base64\r\n",
         "multipart/form-data; boundary=b",
         "boundary=\"",
         "application/xml",
         "text/xml",
         "application/zip",
         "../",
         "/etc/passwd",
         "C:\\",
         "\\\"",
         "{\"width\":64}",
         "<world/>",
         std::string("\0", 1)},
        512};
    return made;
}

}  // namespace farol::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace farol;
    using namespace farol::fuzz;
    const std::string text(reinterpret_cast<const char*>(data), std::min(size, kMaxInput));
    const std::size_t lineEnd = std::min(text.find('\n'), text.size());
    server::http::Request request;
    request.headers.emplace_back("content-type", text.substr(0, lineEnd));
    Bytes body(lineEnd == text.size() ? "" : text.substr(lineEnd + 1));
    try {
        const server::Upload upload = server::readUpload(request, body, kMaxInput);
        checkUpload(upload);
        reached(upload.bundle ? "files " + std::to_string(upload.bundle->files.size()) : "archive");
    } catch (const Error& error) {
        checkError(error);
        reached(error.what());
    }
    return 0;
}
