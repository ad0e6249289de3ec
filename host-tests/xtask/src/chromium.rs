//! A browser without a window, by the DevTools protocol over a pipe: messages of JSON, each ended
//! by a zero. No JSON is parsed: answers are searched for the few values that are asked for.

use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use crate::process;
use crate::toolbox::{Toolbox, Wanted};

const CHROMIUM: Wanted = Wanted {
    name: "chromium",
    alternatives: &[
        &["chromium-headless-shell", "chromium-common", "fonts-dejavu-core", "fontconfig-config"],
        &["chromium", "chromium-common", "fonts-dejavu-core", "fontconfig-config"],
    ],
    ignore_installed: &["chromium", "fonts-dejavu", "fontconfig-config"],
};

/// Limit of all calls to one page. A page takes seconds; WebGL in software is slow.
const LIMIT: Duration = Duration::from_secs(200);

/// Events that tell of an error in a page.
const ERRORS: [&str; 3] = [
    "\"method\":\"Runtime.exceptionThrown\"",
    "\"method\":\"Runtime.consoleAPICalled\",\"params\":{\"type\":\"error\"",
    "\"level\":\"error\"",
];

/// Debian's browser, unpacked aside.
pub struct Chromium {
    toolbox: Toolbox,
}

/// An open page.
pub struct Page {
    browser: Child,
    to: Option<ChildStdin>,
    from: Receiver<String>,
    session: String,
    sent: u32,
    deadline: Instant,
    /// Events that told of errors, as the browser sent them.
    errors: Vec<String>,
}

impl Chromium {
    /// The browser, fetched now if it is not there.
    ///
    /// # Errors
    /// apt's.
    pub fn find() -> Result<Self, String> {
        Ok(Self { toolbox: Toolbox::open(&CHROMIUM)? })
    }

    /// Opens a page of a file in a browser of its own.
    ///
    /// # Errors
    /// The browser's.
    pub fn open(&self, file: &Path, [width, height]: [u32; 2]) -> Result<Page, String> {
        let program = ["chromium-headless-shell", "chromium"]
            .map(|name| self.toolbox.path("usr/lib/chromium").join(name))
            .into_iter()
            .find(|path| path.is_file())
            .ok_or("Debian's package has no browser")?;
        // The browser reads from 3 and writes to 4.
        let mut command = Command::new("sh");
        command.args(["-c", "exec \"$0\" \"$@\" 3<&0 4>&1 1>&2"]).arg(program);
        // One of the libraries looks for another in a folder of its own.
        let folders = self.toolbox.libraries().into_iter();
        let folders = folders.flat_map(|folder| [folder.join("pulseaudio"), folder]);
        let folders: Vec<String> =
            folders.map(|folder| folder.to_string_lossy().into_owned()).collect();
        command.env("LD_LIBRARY_PATH", folders.join(":"));
        // Fonts and their settings of the packages, not of the machine.
        command.env("FONTCONFIG_SYSROOT", self.toolbox.path(""));
        // The sandbox needs rights that a container lacks. The page is our own.
        command.args([
            "--headless",
            "--no-sandbox",
            "--disable-dev-shm-usage",
            "--hide-scrollbars",
        ]);
        command.args(["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]);
        command.arg(format!("--window-size={width},{height}")).arg("--remote-debugging-pipe");
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut browser = command.spawn().map_err(|error| error.to_string())?;
        let (sender, from) = channel();
        if let Some(out) = browser.stdout.take() {
            std::thread::spawn(move || {
                let messages = BufReader::new(out).split(0).map_while(Result::ok);
                messages
                    .map(|bytes| String::from_utf8_lossy(&bytes).into_owned())
                    .try_for_each(|message| sender.send(message))
            });
        }
        let to = browser.stdin.take();
        let deadline = Instant::now() + LIMIT;
        let (session, errors) = (String::new(), Vec::new());
        let mut page = Page { browser, to, from, session, sent: 0, deadline, errors };
        let answer = page.call("Target.createTarget", "\"url\":\"about:blank\"")?;
        let target = value(&answer, "targetId")?;
        let with = format!("\"targetId\":{},\"flatten\":true", quoted(&target));
        page.session = value(&page.call("Target.attachToTarget", &with)?, "sessionId")?;
        page.call("Runtime.enable", "")?;
        page.call("Log.enable", "")?;
        page.call("Page.enable", "")?;
        let address = quoted(&format!("file://{}", file.display()));
        page.call("Page.navigate", &format!("\"url\":{address}"))?;
        page.wait("\"method\":\"Page.loadEventFired\"")?;
        Ok(page)
    }
}

impl Page {
    /// Runs a script whose value is a promise of a text without quotes.
    ///
    /// # Errors
    /// The script's, or no end.
    pub fn run(&mut self, script: &str) -> Result<String, String> {
        let with = format!(
            "\"expression\":{},\"awaitPromise\":true,\"returnByValue\":true",
            quoted(script)
        );
        let answer = self.call("Runtime.evaluate", &with)?;
        if answer.contains("\"exceptionDetails\"") {
            return Err(answer);
        }
        value(&answer, "value")
    }

    /// Writes a picture of the page as PNG.
    ///
    /// # Errors
    /// The browser's; the file cannot be written.
    pub fn photograph(&mut self, picture: &Path) -> Result<(), String> {
        let packed = picture.with_extension("base64");
        let failed = |error: std::io::Error| format!("{}: {error}", picture.display());
        let data = value(&self.call("Page.captureScreenshot", "")?, "data")?;
        fs::write(&packed, data).map_err(failed)?;
        let unpacked = process::output(Command::new("base64").arg("-d").arg(&packed))?;
        fs::write(picture, unpacked.stdout).map_err(failed)?;
        fs::remove_file(&packed).map_err(failed)
    }

    /// Refuses errors that were told so far.
    ///
    /// # Errors
    /// The first one.
    pub fn require_quiet(&self) -> Result<(), String> {
        self.errors.first().map_or(Ok(()), |error| Err(format!("in the console: {error}")))
    }

    /// The window's size, and whether the page is told that a dark one is liked.
    ///
    /// # Errors
    /// The browser's.
    pub fn show_as(&mut self, [width, height]: [u32; 2], is_dark: bool) -> Result<(), String> {
        let liked = if is_dark { "dark" } else { "light" };
        let feature = format!("{{\"name\":\"prefers-color-scheme\",\"value\":\"{liked}\"}}");
        self.call("Emulation.setEmulatedMedia", &format!("\"features\":[{feature}]"))?;
        let size = format!("\"width\":{width},\"height\":{height}");
        let size = format!("{size},\"deviceScaleFactor\":1,\"mobile\":false");
        self.call("Emulation.setDeviceMetricsOverride", &size).map(drop)
    }

    fn call(&mut self, method: &str, parameters: &str) -> Result<String, String> {
        self.sent += 1;
        let session = match self.session.as_str() {
            "" => String::new(),
            session => format!(",\"sessionId\":{}", quoted(session)),
        };
        let id = self.sent;
        let message = format!(
            "{{\"id\":{id},\"method\":\"{method}\",\"params\":{{{parameters}}}{session}}}\0"
        );
        let to = self.to.as_mut().ok_or("the browser has no input")?;
        to.write_all(message.as_bytes()).map_err(|error| error.to_string())?;
        let answer = self.wait(&format!("{{\"id\":{id},"))?;
        if answer.contains("\"error\":{") { Err(format!("{method}: {answer}")) } else { Ok(answer) }
    }

    /// Waits for a message with this text, and keeps errors that arrive before it.
    fn wait(&mut self, text: &str) -> Result<String, String> {
        loop {
            let left = self.deadline.saturating_duration_since(Instant::now());
            let message = self.from.recv_timeout(left);
            let message = message.map_err(|error| format!("the browser: {error}"))?;
            if ERRORS.iter().any(|error| message.contains(error)) && !message.starts_with("{\"id\"")
            {
                self.errors.push(message.chars().take(400).collect());
            }
            if message.contains(text) {
                return Ok(message);
            }
        }
    }
}

impl Drop for Page {
    fn drop(&mut self) {
        // The end of its input ends the browser. The kill is for one that hangs.
        self.to = None;
        let _ = self.browser.kill();
        let _ = self.browser.wait();
    }
}

/// A text as JSON.
fn quoted(text: &str) -> String {
    let mut json = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => json.extend(['\\', c]),
            '\n' => json.push_str("\\n"),
            c => json.push(c),
        }
    }
    json + "\""
}

/// The text of a member of an answer.
fn value(answer: &str, member: &str) -> Result<String, String> {
    let found = answer.split(&format!("\"{member}\":\"")).nth(1);
    let text = found.and_then(|rest| rest.split('"').next());
    text.map(str::to_owned).ok_or_else(|| format!("no {member} in {answer}"))
}

#[cfg(test)]
mod tests {
    use super::{quoted, value};

    #[test]
    fn texts_are_quoted_and_found() {
        assert_eq!(quoted("a\"b\\\nc"), "\"a\\\"b\\\\\\nc\"");
        assert_eq!(value("{\"id\":1,\"result\":{\"x\":\"yes\"}}", "x"), Ok("yes".to_owned()));
        assert!(value("{}", "x").is_err());
    }
}
