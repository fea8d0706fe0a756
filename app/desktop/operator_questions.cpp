#include "app/desktop/operator_questions.h"

#include "app/text/operator_text.h"

namespace zerodrift::desktop {

using controller::OperatorAct;
using controller::OperatorAnswer;
using controller::OperatorRequest;

/// As one step sees it.
class OperatorQuestions::Person : public controller::Operator {
 public:
  Person(std::shared_ptr<OperatorQuestions> questions, std::stop_token stop)
      : m_questions(std::move(questions)), m_stop(std::move(stop)) {}
  Result<OperatorAnswer> ask(const OperatorRequest& request) override { return m_questions->ask(request, m_stop); }

 private:
  std::shared_ptr<OperatorQuestions> m_questions;
  std::stop_token m_stop;
};

std::shared_ptr<controller::Operator> OperatorQuestions::of(const controller::Profile& profile, std::stop_token stop) {
  if (!profile.manual) return nullptr;
  return std::make_shared<Person>(shared_from_this(), std::move(stop));
}

Result<OperatorAnswer> OperatorQuestions::ask(const OperatorRequest& request, const std::stop_token& stop) {
  const std::lock_guard turn(m_one_at_a_time);
  std::unique_lock lock(m_lock);
  if (request.act == OperatorAct::state && m_compensation_on) return OperatorAnswer{m_compensation_on, {}};
  m_open = request;
  m_answer.reset();
  Q_EMIT changed();
  m_answered.wait(lock, stop, [this] { return m_answer.has_value(); });
  m_open.reset();
  Result<OperatorAnswer> answer =
      m_answer ? *std::exchange(m_answer, std::nullopt) : Result<OperatorAnswer>(fail(ErrorCode::cancelled));
  if (answer && request.act == OperatorAct::state) m_compensation_on = answer->compensation_on;
  if (answer && request.act == OperatorAct::switch_compensation) m_compensation_on = request.compensation_on;
  Q_EMIT changed();
  return answer;
}

std::optional<OperatorRequest> OperatorQuestions::open() const {
  const std::lock_guard lock(m_lock);
  return m_answer ? std::nullopt : m_open;
}

void OperatorQuestions::answer(const OperatorAnswer& answer) {
  const std::lock_guard lock(m_lock);
  m_answer = answer;
  m_answered.notify_all();
}

void OperatorQuestions::decline(const QString& reason) {
  const std::lock_guard lock(m_lock);
  if (!m_open) return;
  m_answer = fail(ErrorCode::operator_declined,
                  {{"request", operatorText(*m_open).toStdString()}, {"reason", reason.toStdString()}});
  m_answered.notify_all();
}

void OperatorQuestions::forget() {
  const std::lock_guard lock(m_lock);
  m_compensation_on.reset();
}

}  // namespace zerodrift::desktop
