// Someone who looks on while a bench runs.
#pragma once
#include <functional>
#include <string>

#include "render/session.h"

namespace etendue::bench {

// Is told what part of the work is done, 0 to 1, and what is being done; says whether to go on.
using Progress = std::function<bool(double done, const std::string& what)>;

// Waits until the session has brought this version to its limit, and asks now and then, once it has been taken up,
// whether to go on; if not, the session is stopped and the answer is false.
bool wait_for(render::Session& session, uint64_t version, const std::function<bool(const render::Status&)>& keep_going);

}  // namespace etendue::bench
