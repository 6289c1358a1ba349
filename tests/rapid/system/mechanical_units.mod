! RAPID Functions, GetNextMechUnit: the mechanical units of the task, one after the other.
MODULE mechanical_units
  PROC main()
    VAR num list;
    VAR string name;
    VAR num axes;
    VAR bool robot;
    VAR bool on;
    VAR mecunit unit;
    WHILE GetNextMechUnit(list,name\MecRef:=unit\TCPRob:=robot\NoOfAxes:=axes\Active:=on) DO
      TPWrite name+ValToStr(axes)+ValToStr(robot)+ValToStr(on); ! -> ROB_16TRUETRUE
      TPWrite GetMecUnitName(unit);         ! -> ROB_1
    ENDWHILE
    TPWrite ValToStr(list);                 ! -> 1
    TPWrite GetMecUnitName(ROB_ID);         ! -> ROB_1
  ENDPROC
ENDMODULE
