MODULE unicode
  ! 机器人程序 — 抓取和放置 ✓
  ! Größe in µm, naïve façade
  VAR num groesse:=0;
  PROC main()
    TPWrite "Köln";
    groesse:=groesse+1;
  ENDPROC
ENDMODULE
