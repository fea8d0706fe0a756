#pragma once
// The person at a manual control, as the window asks: a step's thread waits here until the question on the screen is
// answered. What was confirmed once is known until the connection is given up; it is not asked for again.

#include <QObject>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>

#include "core/controller/operator.h"
#include "core/controller/profile.h"

namespace zerodrift::desktop {

class OperatorQuestions : public QObject, public std::enable_shared_from_this<OperatorQuestions> {
  Q_OBJECT

 public:
  /// Who answers for a step; null for a control with a link. A question ends as cancelled when the step is stopped.
  std::shared_ptr<controller::Operator> of(const controller::Profile& profile, std::stop_token stop);

  /// What is asked now.
  std::optional<controller::OperatorRequest> open() const;
  void answer(const controller::OperatorAnswer& answer);
  /// It cannot be done, for this reason.
  void decline(const QString& reason);
  /// Another machine, or the connection was given up.
  void forget();

 Q_SIGNALS:
  /// A question came or went.
  void changed();

 private:
  class Person;
  Result<controller::OperatorAnswer> ask(const controller::OperatorRequest& request, const std::stop_token& stop);

  mutable std::mutex m_lock;
  std::mutex m_one_at_a_time;
  std::condition_variable_any m_answered;
  std::optional<controller::OperatorRequest> m_open;
  std::optional<Result<controller::OperatorAnswer>> m_answer;
  std::optional<bool> m_compensation_on;
};

}  // namespace zerodrift::desktop
