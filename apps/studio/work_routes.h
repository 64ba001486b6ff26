#pragma once
#include <httplib.h>

#include "drive.h"
#include "jobs.h"
#include "project.h"

namespace dashpot::studio {

/// "start", or "stop" and "go_on" of those with that name: {"action", "name", and what is asked}.
void act_on_job(Jobs& jobs, const JobKind& kind, const Value& body);

/// What the views of the machine, of designs and of exports ask for.
class WorkRoutes {
 public:
  WorkRoutes(Project& project, Jobs& jobs) : project_(project), jobs_(jobs), drives_(project) {}
  void add(httplib::Server& server);

 private:
  void add_work(httplib::Server& server);
  void add_machine(httplib::Server& server);
  void add_design(httplib::Server& server);
  void add_export(httplib::Server& server);

  Project& project_;
  Jobs& jobs_;
  Drives drives_;
};

}  // namespace dashpot::studio
