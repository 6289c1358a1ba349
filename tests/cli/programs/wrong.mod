MODULE Wrong
	VAR num parts:=3;
	PROC main()
		parts:=parst+1;
		TPWrite "größer als "+parts;
		WHILE parts>0 DO
			parts:=parts-1
		ENDWHILE
		Gripper_Open;
		Gripper_Open;
		Gripper_Open;
	ENDPROC
ENDMODULE
