#pragma once
// Long work: what it does now, how far it is, how long it takes, and a way out.

#include <QFrame>
#include <optional>

class QLabel;
class QProgressBar;
class QPushButton;

namespace zerodrift::ui {

/// "12 s", "4 min", "3 h 05 min": as coarse as an estimate deserves.
QString durationText(double seconds);

class ProgressStrip : public QFrame {
  Q_OBJECT

 public:
  explicit ProgressStrip(QWidget* parent = nullptr);
  /// fraction 0..1; negative when it cannot be told.
  void setProgress(const QString& phase, double fraction, std::optional<double> secondsLeft = std::nullopt);
  /// What the work waits for, in place of the time left.
  void setWaiting(const QString& what);
  void setCancellable(bool cancellable);
  void clear();

 Q_SIGNALS:
  void cancelRequested();

 protected:
  void changeEvent(QEvent* event) override;

 private:
  QLabel* m_left;
  QProgressBar* m_bar;
  QPushButton* m_cancel;
};

}  // namespace zerodrift::ui
