#pragma once
// One explanation of a mismatch: what, how large, where, how sure, what it improves, and what it cannot be told from.

#include <QFrame>

#include "ui/pages/physics_page.h"

namespace zerodrift::ui {

class Sparkline;

class ExplanationCard : public QFrame {
  Q_OBJECT

 public:
  explicit ExplanationCard(QWidget* parent = nullptr);
  void setExplanation(int rank, const Explanation& explanation);
  const QString& effectId() const { return m_id; }

 Q_SIGNALS:
  void adoptClicked(bool adopt);
  void rejectClicked();

 private:
  QString m_id;
  bool m_adopted = false;
  QLabel* m_name;
  QLabel* m_confidence;
  QLabel* m_sentence;
  QLabel* m_facts;
  QLabel* m_rivals;
  Sparkline* m_spark;
  QLabel* m_improvement;
  QPushButton* m_adopt;
  QPushButton* m_reject;
};

}  // namespace zerodrift::ui
