"""kill -9 of the server while a script edits."""

import copy
import random
import threading
import time

from editor import random_ops
from planner import STORE, ServeTest, command, edited
from websocket import Closed


class Model:
    """The documents of the history, of which the first `position + 1` were made one from the other."""

    def __init__(self, document):
        self.documents = [document]
        self.position = 0

    def now(self):
        return self.documents[self.position]

    def after_edit(self, ops):
        model = copy.copy(self)
        model.documents = [*self.documents[: self.position + 1], edited(self.now(), ops)]
        model.position += 1
        return model

    def after_move(self, position):
        model = copy.copy(self)
        model.position = position
        return model

    def matches(self, tab):
        history = tab.history
        return (tab.json, history["position"], len(history["steps"])) == (
            self.now(),
            self.position,
            len(self.documents) - 1,
        )


class KilledServer(ServeTest):
    def request(self, choose, model):
        """The keys of a random request, and what it leads to."""
        last = len(model.documents) - 1
        do = choose.choice(("edit", "edit", "edit", "edit", "undo", "redo", "go"))
        if do == "undo" and model.position > 0:
            return {"do": "undo"}, model.after_move(model.position - 1)
        if do == "redo" and model.position < last:
            return {"do": "redo"}, model.after_move(model.position + 1)
        if do == "go":
            position = max(0, last - choose.randrange(4))
            return {"do": "go", "position": position}, model.after_move(position)
        ops = random_ops(choose, model.now())
        return {"do": "edit", "label": "Random", "ops": ops}, model.after_edit(ops)

    def edit_until_killed(self, choose, model, tab, server):
        """The model after the last acknowledged request, and after the one that had no answer."""
        acknowledged = 0
        edits, seconds = choose.randrange(15), choose.uniform(0, 0.002)
        while True:
            if acknowledged == edits:
                threading.Timer(seconds, server.process.kill).start()
            request, following = self.request(choose, model)
            try:
                answer = tab.ask(**request)
            except Closed:
                return acknowledged, model, following
            self.assertNotIn("error", answer)
            model = following
            acknowledged += 1

    def kill_while_it_starts(self, seconds):
        process = self.start(*command(self.folder))
        time.sleep(seconds)
        process.kill()

    def kill_often(self, times, seed=1):
        choose = random.Random(seed)
        self.write_store()
        model = following = Model(self.document())
        acknowledged = 0
        for round_number in range(times):
            if round_number % 4 == 3:
                self.kill_while_it_starts(choose.uniform(0, 0.05))
            server = self.serve()
            tab = self.open(server)
            model = next((known for known in (following, model) if known.matches(tab)), None)
            self.assertIsNotNone(model, f"round {round_number}: {tab.history}")
            count, model, following = self.edit_until_killed(choose, model, tab, server)
            server.wait()
            acknowledged += count
            self.assertIn(self.document(), (model.now(), following.now()), "store.json is whole")
        tab = self.open(self.serve())
        self.assertTrue(model.matches(tab) or following.matches(tab))
        last = tab.json
        steps = len(tab.history["steps"])
        position = tab.history["position"]
        self.assertLessEqual(steps, 2000, "the first steps are lost, because a history of more steps is shortened")
        tab.ask("go", position=0)
        self.assertEqual(self.text("store.json"), STORE)
        tab.ask("go", position=position)
        self.assertEqual(self.document(), last)
        self.assertGreater(acknowledged, times)
