#pragma once
// The upload page: old and new table, the transaction as it passes, the sign check, history with rollback.

#include <QDateTime>
#include <functional>
#include <optional>

#include "app/desktop/presenter.h"
#include "core/controller/rollback.h"
#include "core/flow/steps/upload_step.h"

namespace zerodrift::ui {
class UploadPage;
struct SignCheckResult;
struct Stage;
struct UploadState;
}  // namespace zerodrift::ui

namespace zerodrift::desktop {

class UploadPresenter : public Presenter {
  Q_OBJECT

 public:
  UploadPresenter(Workbench& bench, ui::UploadPage* page);
  void refresh() override;
  void forget() override;
  void enter() override;
  Standing standing() const override { return tableStanding(); }
  void tour(std::function<void(bool good)> done) override;
  /// Writes this table instead of the model's: the correction found by a verification. Asks first.
  void writeCorrection(const compensation::Table& table, std::function<void(bool good)> done);
  /// Shows the history with this version chosen; nothing is written before a person has said so.
  void proposeRollback(int version);
  /// In the tour nobody is there to be asked.
  void setAsking(bool asking) { m_asking = asking; }

 private:
  using Done = std::function<void(bool good)>;

  void preview(Done done);
  void askAndWrite(Done done);
  QStringList doubtsOfWriting() const;
  QString factsOfWriting() const;
  QStringList warningsInWords() const;
  bool confirmed(const QString& heading, const QString& text, const QString& deed, const QString& details = {}) const;
  void write(Done done);
  void rollBack(const QString& id);
  void askAndRollBack();
  /// The page shows what would be written, not what was.
  bool showsPreview(bool written) const { return m_preview && (!written || m_correction || m_goingBack); }
  void readLog();
  void checkSign();
  void dryRun();
  void tellForeign();
  bool machineHoldsAnother() const;
  /// Instead of the model's own table; nothing: the model's own.
  std::optional<compensation::Table> chosenTable() const;
  bool takeLostTable();
  void noteSign(const controller::SignCheckRecord& record);
  /// The sign was checked on this machine a short while ago and was right.
  bool signStands() const;
  ui::Stage signStage(const ui::SignCheckResult& sign) const;
  QString machineId() const;
  void exportTable();
  void follow(const controller::UploadStep& step);
  void fillFromPreview(ui::UploadState& state) const;
  void fillFromArtefact(ui::UploadState& state, const nlohmann::json& body) const;
  void fillHistory(ui::UploadState& state) const;
  std::function<void(const controller::UploadStep&)> observer();
  /// The artefact is of the model that is there now.
  bool isWritten() const;
  static long long latestModel(const commissioning::Job& job);

  ui::UploadPage* m_page;
  std::optional<flow::UploadPreview> m_preview;
  std::optional<compensation::Table> m_correction;
  std::optional<compensation::Table> m_lostTable;         // the job's last, which the machine has lost
  std::optional<controller::RollbackTarget> m_goingBack;  // looked at, or being written
  controller::TableLog m_log;
  std::optional<controller::SignCheckRecord> m_sign;
  QDateTime m_signAt;     // when it was checked in this session
  QString m_signMachine;  // and on which
  QDateTime m_dryRunAt;
  std::vector<controller::UploadStep> m_steps;
  long long m_previewOf = 0;  // the model it was made from
  Done m_afterPreview;        // asked for while the machine was being read already
  bool m_reading = false;
  bool m_writing = false;
  bool m_failed = false;
  bool m_asking = true;
};

}  // namespace zerodrift::desktop
