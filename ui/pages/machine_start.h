#pragma once
// Where everything begins: a new job, one of the last, the sample, the virtual machine; and the way through in words.

#include <QString>
#include <QVector>
#include <QWidget>

class QLabel;
class QListWidget;
class QPushButton;

namespace zerodrift::ui {

class Card;

struct RecentJob {
  QString path{};
  QString name{};    // "VMC-850 #3"
  QString detail{};  // "Warm-up recorded, 20 Nov 2026"
};

class MachineStart : public QWidget {
  Q_OBJECT

 public:
  explicit MachineStart(QWidget* parent = nullptr);
  /// Also sets every text anew.
  void setState(const QVector<RecentJob>& recent, bool sampleAvailable);

 Q_SIGNALS:
  void newJobRequested();
  void ownRecordingRequested();
  void openJobRequested(const QString& path);  // empty: let the user choose
  void sampleRequested();
  void virtualMachineRequested();

 private:
  Card* m_startCard;
  Card* m_recentCard;
  QVector<QPushButton*> m_startButtons;
  QVector<QLabel*> m_startNotes;
  QListWidget* m_recent;
  QLabel* m_noRecent;
  Card* m_wayCard;
  QVector<QLabel*> m_way;
};

}  // namespace zerodrift::ui
