"""Other programs that change store.json while pages are open."""

import json
import shutil
import time

from planner import STORE, NotStarted, ServeTest, plain_store


class Outside(ServeTest):
    def setUp(self):
        super().setUp()
        self.write_store()
        self.server = self.serve()
        self.tabs = [self.open(self.server) for _ in range(2)]

    def changed(self):
        """The next change, which both pages are told."""
        events = [tab.next("changed") for tab in self.tabs]
        self.assertEqual(*events)
        return events[0]

    def test_a_valid_text_is_a_step(self):
        self.write_store(STORE.replace("Aisle", "Nave"))
        event = self.changed()
        self.assertNotIn("tab", event)
        self.assertEqual(event["json"]["name"], "Nave")
        self.assertIsNone(event["locked"])
        self.assertEqual([step["label"] for step in event["history"]["steps"]], ["Changed outside"])
        self.tabs[0].ask("undo")
        self.assertEqual(self.text("store.json"), STORE)

    def test_an_edit_after_it_must_fit(self):
        self.write_store(STORE.replace('"at": [1, 1, 0]', '"at": [2, 1, 0]'))
        # Before the server has looked.
        answer = self.tabs[0].set("/fixtures/0/at/0", 3)
        self.assertEqual(answer["error"]["path"], "/fixtures/0/at/0")
        self.assertNotIn("request", self.changed(), "is not the answer to a refused edit")
        self.assertEqual(self.tabs[0].json["fixtures"][0]["at"], [2, 1, 0])
        self.assertEqual(self.tabs[0].set("/fixtures/0/at/0", 3)["revision"], 3)

    def test_a_text_with_problems_is_shown(self):
        self.write_store(STORE.replace('"material": "w" },', '"material": "v" },', 1))
        event = self.changed()
        self.assertIsNone(event["locked"])
        self.assertEqual([problem["pointer"] for problem in event["problems"]], ["/fixtures/0/material"])

    def test_an_invalid_text_locks(self):
        invalid = STORE.replace('"labels": [', '"labels": ')
        self.write_store(invalid)
        event = self.changed()
        self.assertIn("store.json: is not valid JSON (parse error at line ", event["locked"]["message"])
        self.assertEqual(event["revision"], 1)
        refused = self.tabs[0].set("/name", "Nave")
        self.assertIn("is locked", refused["error"]["message"])
        self.assertEqual(self.text("store.json"), invalid, "is not overwritten")
        self.write_store()
        self.assertIsNone(self.changed()["locked"])
        self.assertEqual(self.tabs[1].set("/name", "Nave")["revision"], 2)

    def test_a_removed_file_comes_back(self):
        self.tabs[0].set("/name", "Nave")
        self.changed()
        before = self.bytes("store.json")
        self.store.unlink()
        self.assertIn("was removed", self.changed()["locked"]["message"])
        self.assertNotIn("error", self.tabs[0].ask("restore"))
        self.changed()
        self.assertEqual(self.bytes("store.json"), before)

    def test_a_removed_folder_comes_back(self):
        self.tabs[0].set("/name", "Nave")
        self.changed()
        before = self.text("store.json")
        shutil.rmtree(self.folder)
        self.assertIn(f"{self.folder}: was removed", self.changed()["locked"]["message"])
        for empty in (False, True):  # as the place of a drive that is gone
            if empty:
                self.folder.mkdir()
            for answer in (self.tabs[0].set("/name", "Lost"), self.tabs[0].ask("undo"), self.tabs[0].ask("restore")):
                self.assertIn(f"{self.folder}: was removed", answer["error"]["message"])
            self.assertEqual([path.name for path in self.scratch.iterdir()], ["shop"] * empty)
        self.write_store(STORE.replace("Aisle", "Other"))
        time.sleep(1.5)
        self.assertIn("was removed", self.tabs[0].set("/name", "Lost")["error"]["message"])
        self.assertEqual([path.name for path in self.folder.iterdir()], ["store.json"], "of another shop")
        self.write_store(before)
        self.assertIsNone(self.changed()["locked"])
        self.assertNotIn("error", self.tabs[1].set("/name", "Apse"))
        self.assertEqual(self.document()["name"], "Apse")
        with self.assertRaisesRegex(NotStarted, "is in use"):
            self.serve()
        self.server.kill()
        steps = self.open(self.serve()).history["steps"]
        self.assertEqual(len(steps), 2, steps)

    def test_a_folder_that_moves_is_followed(self):
        moved = self.folder.rename(self.scratch / "moved")
        self.assertNotIn("error", self.tabs[0].set("/name", "Nave"))
        self.assertIn("Nave", self.text(moved / "store.json"))

    def test_a_restored_file_keeps_the_other(self):
        self.write_store("{")
        self.changed()
        self.tabs[0].ask("restore")
        self.assertIsNone(self.changed()["locked"])
        self.assertEqual(self.text("store.json"), STORE)
        self.assertEqual(self.text("store.json.outside-1"), "{")

    def test_other_things_in_its_place_lock(self):
        secret = self.write(self.scratch / "secret.json", plain_store(name="SECRET"))
        self.store.unlink()
        self.store.symlink_to(secret)
        self.assertIn("is a symbolic link", self.changed()["locked"]["message"])
        self.store.unlink()
        self.store.mkdir()
        self.assertIn("is not a regular file", self.changed()["locked"]["message"])
        self.assertNotIn("SECRET", json.dumps(self.tabs[0].events))
