// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/forked_workers.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <system_error>

#include "platform/evaluation/forked_child.hpp"

namespace parallax {
namespace {

constexpr int kPollMilliseconds = 100;

// A message is its length and its bytes.
bool write_all(int descriptor, const std::string& text) {
  const std::uint64_t size = text.size();
  std::string message(sizeof size, '\0');
  std::memcpy(message.data(), &size, sizeof size);
  message += text;
  for (std::size_t sent = 0; sent < message.size();) {
    const ssize_t count = ::write(descriptor, message.data() + sent, message.size() - sent);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    sent += static_cast<std::size_t>(count);
  }
  return true;
}

bool read_exactly(int descriptor, char* bytes, std::size_t size) {
  for (std::size_t got = 0; got < size;) {
    const ssize_t count = ::read(descriptor, bytes + got, size - got);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    got += static_cast<std::size_t>(count);
  }
  return true;
}

bool read_message(int descriptor, std::string& text) {
  std::uint64_t size = 0;
  if (!read_exactly(descriptor, reinterpret_cast<char*>(&size), sizeof size)) return false;
  text.resize(size);
  return read_exactly(descriptor, text.data(), size);
}

}  // namespace

ForkedWorkers::ForkedWorkers(unsigned count, std::function<std::string(const std::string&)> work)
    : workers_(count) {
  for (Worker& worker : workers_) start(worker, work);
}

void ForkedWorkers::start(Worker& worker, const std::function<std::string(const std::string&)>& work) {
  std::array<int, 2> requests{}, answers{};
  const auto fail = [] { throw std::system_error(errno, std::generic_category(), "no process stands by"); };
  if (::pipe2(requests.data(), O_CLOEXEC) != 0) fail();
  if (::pipe2(answers.data(), O_CLOEXEC) != 0) {
    ::close(requests[0]);
    ::close(requests[1]);
    fail();
  }
  const pid_t parent = ::getpid();
  worker.process = ::fork();
  if (worker.process == 0) {
    become_child_of(parent);
    ::close(requests[1]);
    ::close(answers[0]);
    for (const Worker& other : workers_) {
      if (other.requests >= 0) ::close(other.requests);  // or it would not see its end
      if (other.answers >= 0) ::close(other.answers);
    }
    for (std::string request; read_message(requests[0], request);) {
      if (!write_all(answers[1], work(request))) break;
    }
    ::_exit(0);  // no destructors, no buffers: they are the parent's
  }
  ::close(requests[0]);
  ::close(answers[1]);
  worker.requests = requests[1];
  worker.answers = answers[0];
  if (worker.process < 0) {
    end(worker);
    fail();
  }
}

ForkedWorkers::~ForkedWorkers() {
  for (Worker& worker : workers_) end(worker);
}

void ForkedWorkers::end(Worker& worker) {
  if (worker.requests >= 0) ::close(worker.requests);
  if (worker.answers >= 0) ::close(worker.answers);
  worker.requests = worker.answers = -1;
  if (worker.process <= 0) return;
  ::kill(worker.process, SIGKILL);
  while (::waitpid(worker.process, nullptr, 0) < 0 && errno == EINTR) {
  }
  worker.process = -1;
}

bool ForkedWorkers::ask(Worker& worker, const std::string& request) {
  struct sigaction ignore {
  }, before{};
  ignore.sa_handler = SIG_IGN;
  ::sigaction(SIGPIPE, &ignore, &before);  // of a worker that died
  const bool sent = write_all(worker.requests, request);
  ::sigaction(SIGPIPE, &before, nullptr);
  return sent;
}

// A piece of an answer; whether it is complete now. One from a worker that died is empty.
bool ForkedWorkers::receive(Worker& worker, std::string& answer) {
  std::array<char, 65536> buffer;
  const ssize_t count = ::read(worker.answers, buffer.data(), buffer.size());
  if (count < 0 && errno == EINTR) return false;
  if (count <= 0) {
    end(worker);
    answer.clear();
    return true;
  }
  worker.received.append(buffer.data(), static_cast<std::size_t>(count));
  std::uint64_t size = 0;
  if (worker.received.size() < sizeof size) return false;
  std::memcpy(&size, worker.received.data(), sizeof size);
  if (worker.received.size() < sizeof size + size) return false;
  answer = worker.received.substr(sizeof size);
  worker.received.clear();
  return true;
}

std::vector<std::string> ForkedWorkers::answer(const std::vector<std::string>& requests,
                                               const std::function<bool()>& interrupted,
                                               const std::function<void()>& done) {
  std::vector<std::string> answers(requests.size());
  std::size_t next = 0;
  std::size_t under_way = 0;
  const auto hand_out = [&](Worker& worker) {
    while (next < requests.size() && worker.requests >= 0 && worker.working_on < 0) {
      worker.working_on = static_cast<std::ptrdiff_t>(next++);
      if (ask(worker, requests[static_cast<std::size_t>(worker.working_on)])) {
        ++under_way;
      } else {
        worker.working_on = -1;
        end(worker);
        done();
      }
    }
  };
  for (Worker& worker : workers_) hand_out(worker);
  while (under_way > 0) {
    if (interrupted()) return answers;
    std::vector<pollfd> waiting;
    for (const Worker& worker : workers_) {
      waiting.push_back({worker.working_on >= 0 ? worker.answers : -1, POLLIN, 0});
    }
    if (::poll(waiting.data(), waiting.size(), kPollMilliseconds) <= 0) continue;
    for (std::size_t i = 0; i < workers_.size(); ++i) {
      Worker& worker = workers_[i];
      if (waiting[i].revents == 0) continue;
      if (!receive(worker, answers[static_cast<std::size_t>(worker.working_on)])) continue;
      worker.working_on = -1;
      --under_way;
      done();
      hand_out(worker);
    }
  }
  return answers;
}

}  // namespace parallax
