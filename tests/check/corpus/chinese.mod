MODULE chinese
  ! 加工程序
  PROC main()
    TPWrite "开始";
  ENDPROC
ENDMODULE
