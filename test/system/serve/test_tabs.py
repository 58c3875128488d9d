"""Two pages of one project that edit at the same time."""

import random
import threading

from editor import random_ops
from planner import STORE, ServeTest


class Tabs(ServeTest):
    edits = 40

    def setUp(self):
        super().setUp()
        self.write_store()
        self.server = self.serve()
        self.tabs = [self.open(self.server) for _ in range(2)]

    def edit_at_random(self, tab, seed, sent, errors):
        """Keeps the edits that the server acknowledged, by the number of the request, and counts conflicts."""
        choose = random.Random(seed)
        for _ in range(self.edits):
            do = choose.choice(("edit", "edit", "edit", "undo", "redo"))
            ops = random_ops(choose, tab.json) if do == "edit" else None
            answer = tab.ask(do, **({"label": "Random", "ops": ops} if ops else {}))
            if "error" in answer:
                errors.append((tab.number, answer["error"], ops))
            else:
                sent[tab.number, tab.last_id] = (answer["revision"], ops)

    def test_that_edit_at_random_lose_nothing(self):
        sent, errors = {}, []
        threads = [
            threading.Thread(target=self.edit_at_random, args=(tab, seed, sent, errors))
            for seed, tab in enumerate(self.tabs)
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(sent) + len(errors), 2 * self.edits)
        last = max(revision for revision, _ in sent.values())
        for tab in self.tabs:
            tab.reach(last)
            self.assertEqual(tab.json, self.document())
        one, other = (tab.changes() for tab in self.tabs)
        self.assertEqual(one, other)
        self.assertEqual([event["revision"] for event in one], list(range(2, last + 1)))
        # Every acknowledged edit is a change of its own, and nothing else is one.
        changed = {event["revision"]: event for event in one}
        for (tab, request), (revision, ops) in sent.items():
            if ops is not None:
                event = changed.pop(revision)
                self.assertEqual((event["tab"], event["request"], event["ops"]), (tab, request, ops))
        self.assertTrue(all("ops" not in event for event in changed.values()), "only undo and redo are left")
        # Refused edits name the value that had changed.
        for number, error, ops in errors:
            self.assertIn(error["path"], [op["path"] for op in ops], number)
            self.assertTrue(error["message"])
        self.assertNotIn("error", self.tabs[0].ask("go", position=0))
        self.assertEqual(self.text("store.json"), STORE)

    def test_that_edit_the_same_value_conflict(self):
        one, other = self.tabs
        move = {"path": "/fixtures/0/at/0", "before": 1}
        self.assertEqual(one.edit({**move, "after": 2})["revision"], 2)
        answer = other.edit({**move, "after": 3})
        self.assertEqual(answer["error"]["path"], "/fixtures/0/at/0")
        self.assertNotIn("revision", answer)
        other.reach(2)
        self.assertEqual(other.json, self.document())
        self.assertEqual(other.json["fixtures"][0]["at"][0], 2)
        self.assertEqual(other.edit({**move, "before": 2, "after": 3})["revision"], 3)
        one.reach(3)
        self.assertEqual(one.json, other.json)

    def test_share_one_history(self):
        one, other = self.tabs
        one.set("/name", "First", "rename")
        other.reach(2)
        other.set("/name", "Second", "rename again")
        self.assertEqual(one.ask("undo")["revision"], 4)
        other.reach(4)
        self.assertEqual(other.json["name"], "First")
        self.assertEqual([step["label"] for step in other.history["steps"]], ["rename", "rename again"])
        self.assertEqual(other.history["position"], 1)
        late = self.open(self.server)
        self.assertEqual((late.json, late.history), (other.json, other.history))
