#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// A client that writes bytes and reads bytes: it shares nothing with the server's HTTP library
/// and can send what no library would.
namespace farol::test {

struct Answer {
    int status = 0;                                   ///< 0: no answer
    std::multimap<std::string, std::string> headers;  ///< names in lower case
    std::string body;
    bool closed = false;  ///< the server ended the connection after it

    std::string header(const std::string& name) const;
    /// The body as JSON; discarded when it is not.
    nlohmann::json json() const;
    std::string code() const;  ///< of a problem document, else ""
};

/// One connection to 127.0.0.1, from there or from another loopback address.
class RawClient {
  public:
    explicit RawClient(int port, const std::string& from = "");
    ~RawClient();
    RawClient(const RawClient&) = delete;
    RawClient& operator=(const RawClient&) = delete;

    bool send(const std::string& bytes);
    void endSending();
    /// Reads one answer; `withBody` false for HEAD. Status 0 when there is none in a minute.
    Answer read(bool withBody = true);
    /// True if the server ended the connection within a minute.
    bool closedByServer();

  private:
    bool fill();
    int fd_;
    std::string buffer_;
    bool ended_ = false;
};

struct Ask {
    std::string method = "GET";
    std::string target = "/";
    std::vector<std::pair<std::string, std::string>> headers;
    std::string body;
};

/// One request on a separate connection; Content-Length is added where there is a body.
Answer ask(int port, const Ask& request);
Answer get(int port, const std::string& target,
           std::vector<std::pair<std::string, std::string>> headers = {});
Answer post(int port, const std::string& target, const std::string& body,
            const std::string& contentType = "application/xml");

struct FilePart {
    std::string name, fileName, content, contentType;
};
/// A multipart/form-data body with the boundary "frontier".
std::string multipart(const std::vector<FilePart>& parts);
inline constexpr const char* kMultipartType = "multipart/form-data; boundary=frontier";

}  // namespace farol::test
