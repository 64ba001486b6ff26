#include <atomic>
#include <chrono>
#include <cmath>
#include <fcntl.h>
#include <httplib.h>
#include <thread>
#include <unistd.h>

#include <fmt/format.h>
#include <sys/socket.h>

#include "answers.h"
#include "assets.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/registry.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/reader.h"
#include "dashpot/value.h"
#include "guard.h"
#include "job_kinds.h"
#include "jobs.h"
#include "project.h"
#include "sample_view.h"
#include "studio.h"
#include "task_queue.h"
#include "work_routes.h"

namespace fs = std::filesystem;

namespace dashpot::studio {
namespace {

using httplib::Request, httplib::Response;

constexpr std::size_t kThreads = 24, kMostQueued = 128;
constexpr std::size_t kMostUpload = std::size_t{1} << 30;
constexpr int kTimeout = 10;  // s without a byte

/// Of the studio's own pages: they load what the studio serves, and run no script in their text.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
    "img-src 'self' data: blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Everything that the studio answers.
class Studio {
 public:
  Studio(const fs::path& folder)
      : project_(folder), jobs_(project_), work_routes_(project_, jobs_) {}

  void serve(httplib::Server& server, Guard& guard) {
    limit(server);
    server.set_pre_routing_handler([&guard](const Request& request, Response& response) {
      const Asked asked{request.method,
                        request.path,
                        request.get_header_value("Host"),
                        request.get_header_value("Origin"),
                        request.get_header_value("Sec-Fetch-Site"),
                        request.get_header_value("Cookie"),
                        request.get_header_value("Content-Type"),
                        request.get_header_value("X-Dashpot-Key"),
                        request.get_param_value("session")};
      auto refusal = guard.refuse(asked);
      // More than one Host or Origin is nobody's honest request.
      if (request.get_header_value_count("Host") > 1 ||
          request.get_header_value_count("Origin") > 1)
        refusal = Refusal{400, "a header stands twice"};
      if (!refusal) return httplib::Server::HandlerResponse::Unhandled;
      response.set_header("Connection", "close");
      refuse(response, refusal->status, refusal->why);
      return httplib::Server::HandlerResponse::Handled;
    });
    server.set_exception_handler([](const Request&, Response& response, std::exception_ptr thrown) {
      try {
        std::rethrow_exception(thrown);
      } catch (const Error& error) {
        refuse(response, 400, error.what());
      } catch (const std::exception&) {
        refuse(response, 500, "the studio could not do this");
      }
    });
    pages(server);
    session(server, guard);
    recordings(server);
    fits(server);
    comparison(server);
    work_routes_.add(server);
  }

 private:
  static void limit(httplib::Server& server) {
    server.new_task_queue = [] { return new TaskQueue(kThreads, kMostQueued); };
    server.set_payload_max_length(kMostUpload);
    server.set_read_timeout(kTimeout);
    server.set_write_timeout(kTimeout);
    server.set_keep_alive_timeout(2);
    server.set_keep_alive_max_count(200);
    server.set_tcp_nodelay(true);
    server.set_default_headers({{"X-Content-Type-Options", "nosniff"},
                                {"Referrer-Policy", "no-referrer"},
                                {"Cross-Origin-Resource-Policy", "same-origin"},
                                {"Cross-Origin-Opener-Policy", "same-origin"},
                                {"Cache-Control", "no-store"}});
  }

  void pages(httplib::Server& server) {
    for (const Asset& asset : assets())
      server.Get(asset.path == "/" ? "/" : "/" + escaped(asset.path.substr(1)),
                 [&asset](const Request&, Response& response) {
                   response.set_header("Content-Security-Policy", kPolicy);
                   response.set_content(asset.content.data(), asset.content.size(),
                                        std::string(asset.type).c_str());
                 });
    server.Get("/report/([^/]+)", [this](const Request& request, Response& response) {
      answer_report(response, project_.inside("fits/" + request.matches[1].str() + "/report.html"));
    });
  }

  /// A name as a regular expression.
  static std::string escaped(std::string_view name) {
    std::string out;
    for (const char c : name) out += c == '.' ? std::string("\\.") : std::string(1, c);
    return out;
  }

  static void session(httplib::Server& server, Guard& guard) {
    server.Post("/api/session", [&guard](const Request& request, Response& response) {
      const Value body = body_of(request);
      ObjectReader reader(body, "a session");
      const auto session = guard.exchange(reader.string("token"));
      if (!session)
        return refuse(response, 401, "this address was used already; the terminal has another");
      response.set_header("Set-Cookie", session->cookie);
      answer(response,
             Value::object({{"key", session->key}, {"address_key", session->address_key}}));
    });
    server.Post("/api/token", [&guard](const Request&, Response& response) {
      answer(response, Value::object({{"token", guard.make_token()}}));
    });
  }

  void recordings(httplib::Server& server) {
    server.Get("/api/recordings", [this](const Request&, Response& response) {
      Value value = project_.recordings();
      value.add("formats", known_formats());
      answer(response, value);
    });

    // One channel over time, or one over another.
    server.Get("/api/view", [this](const Request& request, Response& response) {
      const SampleView view(project_.samples());
      draw(view, request, response);
    });

    server.Post("/api/correct", [this](const Request& request, Response& response) {
      const Value body = body_of(request);
      ObjectReader reader(body, "a correction");
      const std::string file = reader.string("file"), set = reader.string("set");
      reader.finish();
      answer(response, project_.correct(file, set));
      ++corrections_;
      jobs_.changed();
    });

    server.Post("/api/upload", [this](const Request& request, Response& response,
                                      const httplib::ContentReader& content) {
      take_upload(request, response, content);
    });
  }

  void take_upload(const Request& request, Response& response,
                   const httplib::ContentReader& content) {
    const std::string name = request.get_param_value("name");
    project_.inside(name);  // refused before a byte is kept
    const auto announced = parse_number(request.get_header_value("Content-Length"));
    if (announced && *announced > static_cast<double>(kMostUpload))
      return refuse(response, 413, "a recording may have 1 GiB");
    if (std::atomic_fetch_add(&uploads_, 1) >= kMostUploads) {
      --uploads_;
      return refuse(response, 429, "too many files at once");
    }

    // To a file of its own first; it gets its name when it is whole.
    const fs::path incoming = project_.incoming();
    const int file =
        open(incoming.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0600);
    std::size_t size = 0;
    bool is_whole = file >= 0;
    content([&](const char* data, std::size_t length) {
      size += length;
      for (std::size_t at = 0; is_whole && at < length;) {
        const ssize_t wrote = write(file, data + at, length - at);
        is_whole = wrote > 0;
        at += is_whole ? static_cast<std::size_t>(wrote) : 0;
      }
      return is_whole && size <= kMostUpload;
    });
    if (file >= 0) close(file);
    --uploads_;
    const bool complete =
        is_whole && std::to_string(size) == request.get_header_value("Content-Length");
    try {
      if (!complete) throw Error(name, "did not arrive whole");
      project_.take_in(incoming, name);
    } catch (...) {
      fs::remove(incoming);
      throw;
    }
    fs::remove(incoming);
    answer(response, Value::object({{"done", true}}));
  }

  void fits(httplib::Server& server) {
    // Answered when something is newer than what the page knows, or after a while.
    server.Get("/api/changes", [this](const Request& request, Response& response) {
      const std::size_t version =
          jobs_.wait(static_cast<std::size_t>(std::max(0.0, number_of(request, "since", 0))));
      answer(response, Value::object({{"version", version},
                                      {"corrections", static_cast<double>(corrections_)}}));
    });

    // What there is, and what can be fitted at which cost.
    server.Get("/api/fits", [this](const Request&, Response& response) {
      answer(response, Value::object({{"fits", jobs_.list(job_kind("fit"))}}));
    });
    server.Get("/api/costs", [this](const Request&, Response& response) {
      answer(response, Value::object({{"costs", project_.costs()}}));
    });
    server.Get("/api/models", [](const Request&, Response& response) {
      Value list = Value::array();
      for (const std::string& name : model_names()) {
        const ModelInfo info = model_info(name);
        list.push_back(Value::object({{"name", name}, {"title", info.title}}));
      }
      answer(response, Value::object({{"models", std::move(list)}}));
    });

    server.Post("/api/fits", [this](const Request& request, Response& response) {
      act_on_job(jobs_, job_kind("fit"), body_of(request));
      answer(response, Value::object({{"done", true}}));
    });
  }

  void comparison(httplib::Server& server) {
    server.Get("/api/fitted", [this](const Request&, Response& response) {
      answer(response, Value::object({{"models", Value::array(project_.models())}}));
    });
    // A model as a module that the page runs.
    server.Get("/api/module", [this](const Request& request, Response& response) {
      response.set_content(read_file(project_.module(request.get_param_value("model"))),
                           "text/javascript; charset=utf-8");
    });
    // As /api/view, of the forces that a model gave: channels measured, modelled, residual.
    server.Get("/api/traces", [this](const Request& request, Response& response) {
      const SampleView view(project_.traces(request.get_param_value("model")));
      draw(view, request, response);
    });
  }

  static constexpr int kMostUploads = 4;
  std::atomic<int> uploads_ = 0, corrections_ = 0;
  Project project_;
  Jobs jobs_;
  WorkRoutes work_routes_;
};

}  // namespace

void run_studio(const StudioOptions& options, const std::function<void(const std::string&)>& ready,
                const std::function<bool()>& stop) {
  Studio studio(options.folder);

  // A port of this machine alone, which no other program may share.
  httplib::Server server;
  server.set_socket_options([](int socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  const int port = options.port > 0
                       ? (server.bind_to_port("127.0.0.1", options.port) ? options.port : -1)
                       : server.bind_to_any_port("127.0.0.1");
  if (port <= 0)
    throw Error("port " + std::to_string(options.port), "cannot be had",
                "another one with --port, or none for a free one");

  Guard guard(port);
  studio.serve(server, guard);
  std::thread listening([&] { server.listen_after_bind(); });
  ready("http://127.0.0.1:" + std::to_string(port) + "/#" + guard.make_token());
  while (!stop()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  server.stop();
  listening.join();
}

}  // namespace dashpot::studio
