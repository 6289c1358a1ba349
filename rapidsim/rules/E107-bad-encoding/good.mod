MODULE example
  PROC main()
    TPWrite "Station A to B";
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  ! Grösse, ångström, 20 € and “quotes” of code page 1252
  PROC main()
    TPWrite "Tür zu: ±0.5 °C";
  ENDPROC
ENDMODULE
